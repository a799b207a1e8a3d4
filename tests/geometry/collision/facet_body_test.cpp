// Figures of FCL, an engine of others, against all pairs of facets one by one.
#include "geometry/collision/facet_body.h"
#include "geometry/surfaces/profile.h"
#include "geometry/triangles/triangle_pair.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace billet::geometry::facet_body_test {
namespace {

/// @param size  of the scene, and factor on the mesh's coordinates
FacetBody body_of(const TriangleMesh& mesh, double size = 1.0, double factor = 1.0) {
  DisplayMesh drawing{mesh.points, {}, mesh.triangles};
  for (Vec3& p : drawing.points)
    p *= factor * size;
  return FacetBody(std::move(drawing), size);
}

using Corners = std::array<Vec3, 3>;

std::vector<Corners> triangles(const PlacedBody& placed) {
  std::vector<Corners> list;
  for (const auto& t : placed.body.drawing().triangles) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] =
          placed.pose.to_space(placed.body.drawing().points[static_cast<std::size_t>(t[i])]);
    list.push_back(corners);
  }
  return list;
}

/// Distance of two edges between inner points of both; ends are corners against triangles.
double edge_distance(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const double a = u.dot(u), b = u.dot(v), c = v.dot(v), d = u.dot(p - q), e = v.dot(p - q);
  const double determinant = a * c - b * b;
  if (determinant <= 1e-14 * a * c)
    return std::numeric_limits<double>::infinity();
  const double s = (b * e - c * d) / determinant, t = (a * e - b * d) / determinant;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0)
    return std::numeric_limits<double>::infinity();
  return (p + s * u - q - t * v).norm();
}

double brute_distance(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, distance_to_triangle(a[i], b[0], b[1], b[2]),
                      distance_to_triangle(b[i], a[0], a[1], a[2])});
    for (std::size_t j = 0; j < 3; ++j)
      least =
          std::min(least, edge_distance(a[i], a[(i + 1) % 3] - a[i], b[j], b[(j + 1) % 3] - b[j]));
  }
  return least;
}

double brute_clearance(const PlacedBody& a, const PlacedBody& b) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<Corners> others = triangles(b);
  for (const Corners& s : triangles(a))
    for (const Corners& other : others)
      least = std::min(least, brute_distance(s, other));
  return least;
}

/// Depth of the deepest pair that cuts; 0: none.
double brute_cut(const PlacedBody& a, const PlacedBody& b) {
  double deepest = 0.0;
  const std::vector<Corners> others = triangles(b);
  for (const Corners& s : triangles(a))
    for (const Corners& other : others)
      if (const TrianglePair pair(s, other); pair.meets())
        deepest = std::max(deepest, pair.depth());
  return deepest;
}

Pose random_pose(std::mt19937& generator, double shift) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Vec3 axis = Vec3(any(generator), any(generator), any(generator)).normalized();
  Pose pose = rotation_about(Vec3::Zero(), axis, 3.0 * any(generator));
  pose.translation = shift * Vec3(any(generator), any(generator), any(generator));
  return pose;
}

TEST(FacetBody, ClearanceAndCutsAreThoseOfAllPairsInEveryUnit) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const FacetBody a = body_of(spiky(5), unit), b = body_of(spiky(4), unit, 0.7);
    std::mt19937 generator(3);
    int apart = 0, cutting = 0;
    for (int k = 0; k < 150; ++k) {
      const PlacedBody here{a, random_pose(generator, unit)};
      const PlacedBody there{b, random_pose(generator, 2.5 * unit)};
      const double cut = brute_cut(here, there);
      const auto found = deepest_cut(here, there);
      EXPECT_NEAR(found ? found->depth : 0.0, cut, 1e-12 * unit)
          << "unit " << unit << " pose " << k;
      if (cut > 0.0) {
        ++cutting;
        EXPECT_EQ(clearance(here, there), 0.0);
        continue;
      }
      ++apart;
      EXPECT_NEAR(clearance(here, there), brute_clearance(here, there), 1e-9 * unit)
          << "unit " << unit << " pose " << k;
    }
    EXPECT_GT(apart, 20);
    EXPECT_GT(cutting, 10);
  }
}

TEST(FacetBody, ClearanceOfFineFacetsIsRightToo) {
  // Small bodies in a large scene: in the scene's unit FCL would take the normals of their facets
  // for zero.
  constexpr double small = 1e-3;
  const auto bumpy = [](const Vec3& n) { return 1.0 + 0.2 * n.x() * n.y(); };
  const FacetBody a = body_of(star(24, bumpy), 1.0, small), b = body_of(cube(), 1.0, small);
  std::mt19937 generator(9);
  for (int k = 0; k < 10; ++k) {
    Pose away = random_pose(generator, 0.1 * small);
    away.translation.x() += 2.0 * small;
    EXPECT_NEAR(clearance({a, {}}, {b, away}), brute_clearance({a, {}}, {b, away}), 1e-9 * small);
  }
}

TEST(FacetBody, FacesThatLieOnEachOtherDoNotCut) {
  const FacetBody a = body_of(cube()), b = body_of(cube());
  Pose beside;
  beside.translation = Vec3(1.0, 0.0, 0.0);
  const auto cut = deepest_cut({a, {}}, {b, beside});
  EXPECT_LE(cut ? cut->depth : 0.0, 1e-12);
  beside.translation = Vec3(0.99, 0.3, 0.2);
  const auto deep = deepest_cut({a, {}}, {b, beside});
  ASSERT_TRUE(deep);
  EXPECT_NEAR(deep->depth, 0.01, 1e-9);
  EXPECT_NEAR(deep->place.x(), 0.995, 0.006);
}

TEST(FacetBody, AClosedDrawingIsKnownFromASheetAndAnOpenProfile) {
  EXPECT_TRUE(closed(body_of(cube()).drawing()));
  EXPECT_TRUE(closed(body_of(sphere_mesh(6)).drawing()));
  EXPECT_FALSE(closed(body_of(sheet(3, [](double, double) { return 0.0; })).drawing()));
  const std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 1}};
  EXPECT_TRUE(closed(make_profile(polygon(corners, true))->display({}, true)));
  EXPECT_FALSE(closed(make_profile(polygon(corners, false))->display({}, true)));
  EXPECT_FALSE(closed({}));
}

TEST(FacetBody, ProfilesInThePlaneHaveDistancesAndCuts) {
  const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, tip{{-1, 3}, {0, 0}, {1, 3}};
  const FacetBody a(make_profile(polygon(square, true))->display({}, true), 1.0);
  const FacetBody b(make_profile(polygon(tip, false))->display({}, true), 1.0);
  Pose above;
  above.translation = Vec3(0.4, 1.7, 0.0);
  EXPECT_NEAR(clearance({a, {}}, {b, above}), 0.7, 1e-12);
  EXPECT_FALSE(deepest_cut({a, {}}, {b, above}));
  above.translation.y() = 0.9;
  const auto cut = deepest_cut({a, {}}, {b, above});
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->depth, 0.1, 1e-12);
  EXPECT_NEAR(cut->place.y(), 1.0, 1e-12);
}

} // namespace
} // namespace billet::geometry::facet_body_test
