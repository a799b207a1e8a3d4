#include "geometry/surfaces/triangle_surface.h"
#include "geometry/triangles/triangle_features.h"
#include "geometry/triangles/triangle_surroundings.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace billet::geometry::triangle_surroundings_test {
namespace {

Surroundings around(const TriangleMesh& mesh, std::int32_t triangle) {
  SurroundingsOf gathered(mesh, triangle);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    gathered.add(static_cast<std::int32_t>(t));
  return gathered.result();
}

TEST(TriangleSurroundings, OfAFlatSheetAreFlat) {
  const TriangleMesh mesh = sheet(6, [](double, double) { return 0.0; });
  const Surroundings flat = around(mesh, 40);
  EXPECT_EQ(flat.slope, 0.0F);
  EXPECT_NEAR(flat.radius, std::sqrt(2.0) / 6.0, 1e-5); // the longest side
}

TEST(TriangleSurroundings, OfARoofAreAsSteepAsTheRoof) {
  const TriangleMesh mesh = sheet(2, [](double x, double) { return 0.3 * std::abs(x - 0.5); });
  const double angle = 2.0 * std::atan(0.3);
  EXPECT_NEAR(around(mesh, 0).slope, std::tan(angle), 1e-5);
}

TEST(TriangleSurroundings, AnOppositeWallIsKeptAwayFrom) {
  TriangleMesh mesh = sheet(2, [](double, double) { return 0.0; });
  const TriangleMesh above = flipped(sheet(2, [](double, double) { return 0.1; }));
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), above.points.begin(), above.points.end());
  for (const auto& [a, b, c] : above.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
  const Surroundings narrow = around(mesh, 3);
  EXPECT_LE(narrow.slope, 1.0F); // of the parts of the wall outside of it
  EXPECT_NEAR(narrow.radius, 0.1, 1e-6);
  EXPECT_TRUE(is_nearest(narrow, 0.04, 0.01, 0.0));
  EXPECT_FALSE(is_nearest(narrow, 0.06, 0.01, 0.0));
}

TEST(TriangleSurroundings, BesideTheTriangleNothingIsCertain) {
  EXPECT_FALSE(is_nearest({0.0F, 1.0F}, 0.1, -1e-3, 0.0));
  EXPECT_FALSE(is_nearest({0.0F, 1.0F}, 0.1, 0.0, 0.0));
  EXPECT_FALSE(is_nearest({0.0F, 1.0F}, 0.1, 1e-8, 1e-12)); // an edge is as near, but for rounding
}

// What is called certain must be what the search of all triangles finds.
TEST(TriangleSurroundings, WhatIsCertainIsRight) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  for (const TriangleMesh& mesh :
       {cube(), angle_bar(), spiky(6), icosphere(2), sphere_mesh(12), cone(20)}) {
    const TriangleFeatures features(mesh);
    std::size_t certain = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto number = static_cast<std::int32_t>(t);
      const Surroundings known = around(mesh, number);
      const Vec3 a = corner(mesh, t, 0), b = corner(mesh, t, 1), c = corner(mesh, t, 2);
      const Vec3 normal = (b - a).cross(c - a).normalized();
      for (int k = 0; k < 50; ++k) {
        const double v = random(generator), w = (1.0 - v) * random(generator);
        const double height = std::pow(10.0, -3.0 * random(generator)) * (k % 2 == 0 ? 1.0 : -1.0);
        const Vec3 x = a + v * (b - a) + w * (c - a) + height * normal;
        if (!is_nearest(known, std::abs(height), features.inside(number, x).distance, 1e-12))
          continue;
        ++certain;
        EXPECT_NEAR(brute_distance(mesh, x), std::abs(height), 1e-13);
      }
    }
    if (mesh.triangles.size() > 300U) { // smooth enough for many points to be certain
      EXPECT_GT(certain, 10 * mesh.triangles.size());
    }
  }
}

} // namespace
} // namespace billet::geometry::triangle_surroundings_test
