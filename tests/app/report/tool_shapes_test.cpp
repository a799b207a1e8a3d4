#include "app/report/tool_shapes.h"
#include "geometry/base/box.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace billet::report::tool_shapes_test {
namespace {

/// A wavy square of 2 n n triangles, one value each.
io::SurfaceFrame square(int n) {
  io::SurfaceFrame surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.points.emplace_back(i, j, 0.3 * ((i * i + 3 * j) % 5));
  std::vector<double> values;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      surface.polygons.push_back({a, a + 1, a + n + 2});
      surface.polygons.push_back({a, a + n + 2, a + n + 1});
      values.insert(values.end(), {1.0 * i, 1.0 * i});
    }
  surface.cell_fields.push_back({"wear_depth", 1, values, "mm"});
  return surface;
}

TEST(ToolShapes, StoresATravellingToolOnce) {
  ToolShapes shapes;
  Blob frame;
  io::SurfaceFrame surface = square(6);
  EXPECT_FALSE(shapes.add("die", surface, frame).contains("pose"));
  Eigen::Affine3d motion = Eigen::Translation3d(1.0, -2.0, 30.0) *
                           Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, 0.5).normalized());
  for (Vec3& point : surface.points)
    point = motion * point;
  const auto moved = shapes.add("die", surface, frame);
  EXPECT_EQ(shapes.blobs().size(), 1U);
  ASSERT_EQ(moved["pose"].size(), 12U);
  EXPECT_NEAR(moved["pose"][11].get<double>(), motion.matrix()(2, 3), 1e-9);
  EXPECT_NEAR(moved["pose"][1].get<double>(), motion.matrix()(0, 1), 1e-9);
  EXPECT_EQ(moved["fields"]["wear_depth"]["n"], 72);
}

TEST(ToolShapes, StoresAnotherShapeAnew) {
  ToolShapes shapes;
  Blob frame;
  io::SurfaceFrame surface = square(4);
  EXPECT_EQ(shapes.add("die", surface, frame)["shape"], 0);
  surface.points.back()[2] += 0.5;
  EXPECT_EQ(shapes.add("die", surface, frame)["shape"], 1);
  EXPECT_EQ(shapes.add("punch", surface, frame)["shape"], 2);
  EXPECT_EQ(shapes.blobs().size(), 3U);
}

TEST(ToolShapes, ThinsASurfaceOfVeryManyTriangles) {
  io::SurfaceFrame surface = square(150);
  const std::size_t before = surface.polygons.size();
  ASSERT_EQ(before, 45000U);
  const std::vector<std::size_t> stay = thin(surface, 10000);
  EXPECT_EQ(surface.polygons.size(), stay.size());
  EXPECT_LE(stay.size(), 10000U);
  EXPECT_GT(stay.size(), 4000U);
  EXPECT_EQ(surface.cell_fields[0].values.size(), stay.size());
  for (const auto& polygon : surface.polygons)
    for (const mechanics::Index node : polygon)
      EXPECT_LT(idx(node), surface.points.size());
  const auto bounds = box_of(surface.points);
  EXPECT_NEAR(bounds.size(), 150.0 * std::sqrt(2.0), 6.0);
}

TEST(ToolShapes, SaysWhichToolIsThinned) {
  ToolShapes shapes;
  Blob frame;
  io::SurfaceFrame surface = square(150);
  static_cast<void>(shapes.add("die", surface, frame));
  for (Vec3& point : surface.points)
    point[2] += 3.0;
  const auto moved = shapes.add("die", surface, frame);
  EXPECT_EQ(shapes.thinned().at("die"), 45000U);
  EXPECT_EQ(shapes.blobs().size(), 1U);
  EXPECT_LT(moved["fields"]["wear_depth"]["n"].get<int>(), 45000);
}

} // namespace
} // namespace billet::report::tool_shapes_test
