#include "geometry/surfaces/surface_of_revolution.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

namespace billet::geometry::surface_of_revolution_test {
namespace {

constexpr double rounding = 1e-13;

TEST(SurfaceOfRevolution, TheFrameOfAnyAxisIsOrthonormal) {
  for (const Vec3& direction : random_points(50, 1.0)) {
    const Axis axis = make_axis({1, 2, 3}, direction);
    EXPECT_NEAR(axis.direction.norm(), 1.0, rounding);
    EXPECT_NEAR(axis.perpendicular.norm(), 1.0, rounding);
    EXPECT_NEAR(axis.direction.dot(axis.perpendicular), 0.0, rounding);
  }
  EXPECT_EQ(make_axis({0, 0, 0}, {1, 2, 0}).perpendicular.z(), 0.0);
  EXPECT_EQ(make_axis({0, 0, 0}, {0, 0, 1}).perpendicular.z(), 0.0);
}

TEST(SurfaceOfRevolution, CoordinatesRebuildThePoint) {
  const Axis axis = make_axis({0.1, 0.2, 0.3}, {1, 2, -2});
  for (const Vec3& x : random_points(100, 2.0)) {
    const AxisCoordinates c = axis_coordinates(axis, x, 1.0);
    EXPECT_NEAR((axis.origin + c.h * axis.direction + c.r * c.e_r - x).norm(), 0.0, rounding);
  }
  const AxisCoordinates on = axis_coordinates(axis, axis.origin + 3.0 * axis.direction, 1.0);
  EXPECT_EQ(on.r, 0.0);
  EXPECT_EQ(on.e_r, axis.perpendicular);
}

TEST(SurfaceOfRevolution, TheDiskExtentIsTheHalfWidthOfACircle) {
  const Axis axis = make_axis(Vec3::Zero(), {0, 3, 4});
  EXPECT_NEAR((disk_extent(axis) - Vec3(1.0, 0.8, 0.6)).norm(), 0.0, rounding);
}

} // namespace
} // namespace billet::geometry::surface_of_revolution_test
