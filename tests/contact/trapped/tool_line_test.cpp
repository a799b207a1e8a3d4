#include "contact/trapped/tool_line.h"
#include "geometry/surfaces/analytic_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::contact::tool_line_test {
namespace {

Box window() { return {Vec3(-5, -5, 0), Vec3(5, 5, 0)}; }

double length(const std::vector<Vec3>& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i)
    sum += (way[i] - way[i - 1]).norm();
  return sum;
}

TEST(ToolLine, GoesAlongAPlaneInOneDirectionOnly) {
  const auto plane = geometry::make_plane({0, 1, 0}, {0, 1, 0});
  const ToolLine line(*plane, {}, window());
  ASSERT_FALSE(line.empty());
  const LinePlace a = line.nearest({-2, 3, 0}), b = line.nearest({2, 0, 0});
  EXPECT_NEAR((a.point - Vec3(-2, 1, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(b.distance, 1.0, 1e-12);
  int found = 0;
  for (const bool forward : {true, false})
    if (const auto way = line.way(a, b, forward)) {
      ++found;
      EXPECT_NEAR(length(*way), 4.0, 1e-12);
      EXPECT_NEAR((way->back() - b.point).norm(), 0.0, 1e-12);
    }
  EXPECT_EQ(found, 1);
}

TEST(ToolLine, GoesRoundACircleInBoth) {
  const auto circle = geometry::make_circle({0, 0, 0}, 2.0, false);
  const ToolLine line(*circle, {}, window());
  const LinePlace a = line.nearest({3, 0, 0}), b = line.nearest({0, 3, 0});
  double sum = 0.0, shortest = 100.0;
  for (const bool forward : {true, false}) {
    const auto way = line.way(a, b, forward);
    ASSERT_TRUE(way);
    sum += length(*way);
    shortest = std::min(shortest, length(*way));
  }
  EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 0.01); // drawn by chords
  EXPECT_NEAR(shortest, std::numbers::pi, 0.01);
}

TEST(ToolLine, EndsAtALineOfSymmetry) {
  const auto plane = geometry::make_plane({0, 1, 0}, {0, 1, 0});
  geometry::Pose up;
  up.translation = {0, 0.5, 0};
  const ToolLine line(*plane, up, window());
  const LinePlace from = line.nearest({3, 0, 0});
  const SymmetryLine axis{0, 0.0}, beyond{1, 0.0};
  int found = 0;
  for (const bool forward : {true, false}) {
    if (const auto way = line.way(from, axis, forward)) {
      ++found;
      EXPECT_NEAR((way->back() - Vec3(0, 1.5, 0)).norm(), 0.0, 1e-12);
    }
    EXPECT_FALSE(line.way(from, beyond, forward)); // parallel to it
  }
  EXPECT_EQ(found, 1);
}

} // namespace
} // namespace billet::contact::tool_line_test
