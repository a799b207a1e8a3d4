#include "geometry/collision/convex_polygon.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

namespace billet::geometry::convex_polygon_test {
namespace {

const std::array<Vec3, 3> triangle{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};
const std::array<Vec3, 2> line{Vec3(0, 0, 0), Vec3(4, 2, 0)};

TEST(ConvexPolygon, keeps_the_side_of_a_cut_that_it_points_to) {
  ConvexPolygon left(triangle), right(triangle);
  left.cut({1, 0, 0}, -Vec3::UnitX());
  right.cut({1, 0, 0}, Vec3::UnitX());
  EXPECT_DOUBLE_EQ(ConvexPolygon(triangle).area_vector()[2], 8.0);
  EXPECT_DOUBLE_EQ(left.area_vector()[2], 3.5);
  EXPECT_DOUBLE_EQ(right.area_vector()[2], 4.5);
}

TEST(ConvexPolygon, of_cuts_at_random_parts_add_up) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&] {
    const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
    return Vec3(x, y, z);
  };
  for (int i = 0; i < 200; ++i) {
    ConvexPolygon kept(triangle);
    double lost = 0.0;
    for (int c = 0; c < 6; ++c) {
      const Vec3 point = Vec3(1, 1, 1) + random(), inward = random();
      ConvexPolygon other = kept;
      other.cut(point, -inward);
      kept.cut(point, inward);
      lost += other.area_vector()[2];
    }
    EXPECT_NEAR(kept.area_vector()[2] + lost, 8.0, 1e-12);
  }
}

TEST(ConvexPolygon, knows_its_longest_way_across) {
  ConvexPolygon kept(triangle);
  kept.cut({0, 3, 0}, -Vec3::UnitY());
  const auto [a, b] = kept.farthest_corners();
  EXPECT_EQ(a, Vec3(4, 0, 1));
  EXPECT_EQ(b, Vec3(0, 3, 1));
  EXPECT_EQ(kept.corners().size(), 4U);
  EXPECT_EQ(kept.middle(), Vec3(1.25, 1.5, 1));
}

TEST(ConvexPolygon, of_a_line_is_a_line) {
  Box box;
  box.add({1, -5, -std::numeric_limits<double>::infinity()});
  box.add({3, 5, std::numeric_limits<double>::infinity()});
  ConvexPolygon kept(line);
  kept.cut(box);
  ASSERT_EQ(kept.corners().size(), 2U);
  EXPECT_EQ(kept.corners()[0], Vec3(1, 0.5, 0));
  EXPECT_EQ(kept.corners()[1], Vec3(3, 1.5, 0));
  kept.cut({0, 3, 0}, Vec3::UnitY());
  EXPECT_TRUE(kept.empty());
}

} // namespace
} // namespace billet::geometry::convex_polygon_test
