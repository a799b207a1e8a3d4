#include "geometry/triangles/triangle_features.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

namespace billet::geometry::triangle_features_test {
namespace {

constexpr double rounding = 1e-12; // coordinates up to 3

TEST(TriangleFeatures, DistanceToATriangleAgreesWithItsBarycentricRegions) {
  const TriangleMesh mesh = spiky(5);
  const TriangleFeatures features(mesh);
  for (const Vec3& x : random_points(100, 2.0))
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double expected =
          distance_to_triangle(x, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2));
      const ClosestFeature closest = features.closest(static_cast<std::int32_t>(t), x);
      EXPECT_NEAR(std::sqrt(closest.distance2), expected, rounding);
    }
}

TEST(TriangleFeatures, TwoTrianglesNameTheSameFeatureWithTheSameBits) {
  const TriangleFeatures features(cube());
  // Beyond the edge x = y = 1 and beyond the corner (1, 1, 1): several triangles tie.
  for (const auto& [x, feature] : {std::pair{Vec3(1.3, 1.4, 0.3), Feature::edge},
                                   std::pair{Vec3(1.3, 1.4, 1.2), Feature::vertex}}) {
    ClosestFeature best{1e300, Feature::face, -1};
    for (std::int32_t t = 0; t < 12; ++t)
      if (const ClosestFeature c = features.closest(t, x); c.distance2 < best.distance2)
        best = c;
    EXPECT_EQ(best.feature, feature);
    int ties = 0;
    for (std::int32_t t = 0; t < 12; ++t) {
      const ClosestFeature c = features.closest(t, x);
      if (c.distance2 != best.distance2)
        continue;
      ++ties;
      EXPECT_EQ(c.feature, best.feature);
      EXPECT_EQ(c.number, best.number);
    }
    EXPECT_GE(ties, 2);
  }
}

} // namespace
} // namespace billet::geometry::triangle_features_test
