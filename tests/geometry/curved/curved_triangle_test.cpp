// One curved triangle and the facets near it. (G.19), (G.50)

#include "geometry/curved/curved_triangle.h"
#include "geometry/curved/edge_curves.h"
#include "geometry/triangles/corner_normals.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

namespace billet::geometry::curved_triangle_test {
namespace {

/// The curved triangles over a mesh without sharp edges.
std::vector<CurvedTriangle> curved(const TriangleMesh& mesh) {
  const CornerNormals normals = corner_normals(mesh, std::numbers::pi);
  const EdgeCurves edges = edge_curves(mesh, normals);
  std::vector<CurvedTriangle> patches;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    patches.push_back(curved_triangle(mesh, edges, t));
  return patches;
}

std::vector<Vec3> points_of(const CurvedTriangle& patch, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      points.push_back(patch.at(static_cast<double>(i) / n, static_cast<double>(j) / n).position);
  return points;
}

/// Round bodies of even and of uneven facets, hollows and bumps.
std::vector<TriangleMesh> shapes() {
  return {icosphere(1), sphere_mesh(6), cone(12),
          sheet(5, [](double x, double y) { return 0.1 * std::sin(4.0 * x) * std::cos(3.0 * y); })};
}

constexpr double rounding = 1e-13;

TEST(CurvedTriangle, LiesWithinTheRiseOfItsFacetAndOfItsQuarters) {
  for (const TriangleMesh& mesh : shapes()) {
    const std::vector<CurvedTriangle> patches = curved(mesh);
    for (std::size_t t = 0; t < patches.size(); ++t) {
      const Quarters quarters = patches[t].quarters();
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT((quarters.points[i] - corner(mesh, t, i)).norm(), rounding);
      for (const Vec3& p : points_of(patches[t], 12)) {
        EXPECT_LE(
            distance_to_triangle(p, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)),
            patches[t].rise() + rounding);
        EXPECT_LT(quarters.least_distance2(p), rounding * rounding);
      }
    }
  }
}

TEST(CurvedTriangle, IsNoNearerToAPointThanItsQuartersTell) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> component(-1.5, 1.5);
  double short_by = 0.0, rises = 0.0;
  for (const TriangleMesh& mesh : shapes())
    for (const CurvedTriangle& patch : curved(mesh)) {
      const Quarters quarters = patch.quarters();
      const std::vector<Vec3> points = points_of(patch, 24);
      for (int k = 0; k < 20; ++k) {
        const Vec3 x(component(generator), component(generator), component(generator));
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& p : points)
          nearest = std::min(nearest, (p - x).norm());
        const double least = std::sqrt(quarters.least_distance2(x));
        EXPECT_LE(least, nearest + rounding);
        short_by += nearest - least;
        rises += patch.rise();
      }
    }
  std::printf("distance less the bound of the quarters: %.2f of the rise of the facet\n",
              short_by / rises);
  EXPECT_LT(short_by / rises, 0.5); // twice a quarter where the surface bends away from the point
}

TEST(CurvedTriangle, RisesOverItsQuartersByAQuarter) {
  double most = 0.0;
  for (const CurvedTriangle& patch : curved(icosphere(2)))
    for (const double rise : patch.quarters().rises)
      most = std::max(most, rise / patch.rise());
  std::printf("rise over a quarter at most %.3f of that over the facet\n", most);
  EXPECT_LT(most, 0.3);
}

} // namespace
} // namespace billet::geometry::curved_triangle_test
