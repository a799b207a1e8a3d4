// Tetrahedra made better: joined otherwise, contracted away. (G.47), (G.52), (G.53)

#include "geometry/base/index.h"
#include "geometry/mesh3d/patch_mesher.h"
#include "geometry/mesh3d/solid_contraction.h"
#include "geometry/mesh3d/solid_quality.h"
#include "geometry/mesh3d/solid_reconnection.h"
#include "geometry/repair/mesh_health.h"
#include "tests/geometry/sample_meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace billet::geometry::solid_quality_test {
namespace {

double volume_of(const SolidMesh& mesh, const std::array<std::int32_t, 4>& corners) {
  const auto x = [&](std::size_t i) { return mesh.points[idx(corners[i])]; };
  return (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) / 6.0;
}

double worst_quality(const SolidMesh& mesh) {
  double worst = std::numeric_limits<double>::infinity();
  for (const auto& corners : mesh.tetrahedra) {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      x[i] = mesh.points[idx(corners[i])];
    worst = std::min(worst, shape_quality(x));
  }
  return worst;
}

/// Two tips (nodes 0 and 1) under and over a ring of n nodes, joined by an edge that all tetrahedra
/// share; `reach` is that of the tips' places to the sides.
SolidMesh around_an_axis(int n, double height, double reach, std::mt19937& random) {
  std::uniform_real_distribution<double> off(-reach, reach), wide(0.6, 1.4);
  SolidMesh mesh;
  mesh.points = {{off(random), off(random), -height}, {off(random), off(random), height}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    mesh.points.push_back(wide(random) * Vec3(std::cos(angle), std::sin(angle), off(random)));
    mesh.tetrahedra.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
  }
  return mesh;
}

/// What the reconnection of tetrahedron 0 fills, of what there was.
void expect_same_space(const SolidMesh& mesh, const Reconnection& way) {
  double before = 0.0, after = 0.0, worst = std::numeric_limits<double>::infinity();
  for (const std::size_t e : way.old)
    before += volume_of(mesh, mesh.tetrahedra[e]);
  for (const auto& corners : way.fresh) {
    EXPECT_GT(volume_of(mesh, corners), 0.0);
    after += volume_of(mesh, corners);
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      x[i] = mesh.points[idx(corners[i])];
    worst = std::min(worst, shape_quality(x));
  }
  EXPECT_NEAR(after, before, 1e-14 * before);
  EXPECT_EQ(way.worst, worst);
}

TEST(BentQuality, IsThatOfTheTangentsAtCorners) {
  // One edge of a corner of a cube is bent by b to the side; worst is the corner at its end, where
  // (4 x - 3 x_1 - x_0) turns towards the third edge.
  const std::array<Vec3, 4> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto bent = [&](double b) {
    return bent_quality(x, {Vec3(0.5, b, 0.0), 0.5 * (x[1] + x[2]), 0.5 * (x[2] + x[0]),
                            0.5 * (x[0] + x[3]), 0.5 * (x[1] + x[3]), 0.5 * (x[2] + x[3])});
  };
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(bent(0.0), std::sqrt(0.5), rounding);
  EXPECT_NEAR(bent(0.125), 0.5 / std::sqrt(2.5), rounding);
  EXPECT_NEAR(bent(0.25), 0.0, rounding);
  EXPECT_LT(bent(0.3), 0.0);
  // A regular one has 1.
  const std::array<Vec3, 4> regular{{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  std::array<Vec3, 6> middles;
  constexpr std::array<std::array<std::size_t, 2>, 6> ends{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t i = 0; i < 6; ++i)
    middles[i] = 0.5 * (regular[ends[i][0]] + regular[ends[i][1]]);
  EXPECT_NEAR(bent_quality(regular, middles), 1.0, rounding);
  EXPECT_NEAR(shape_quality(regular), 1.0, rounding);
}

TEST(SolidReconnection, AnEdgeGivesWayToTheTrianglesOfItsRing) {
  std::mt19937 random(7);
  for (const int n : {3, 4, 5, 6, 7, 8}) {
    int changed = 0;
    for (int trial = 0; trial < 400; ++trial) {
      SolidMesh mesh = around_an_axis(n, 1.0, 0.5, random);
      const double before = worst_quality(mesh);
      if (before <= 0.0)
        continue;
      SolidStars stars(mesh);
      const std::optional<Reconnection> way = reconnection(stars, 0);
      if (!way || way->old.size() != idx(n)) // or a face may be the better one to go
        continue;
      ++changed;
      EXPECT_EQ(way->fresh.size(), idx(2 * (n - 2)));
      expect_same_space(mesh, *way);
      EXPECT_GT(way->worst, before);
      stars.replace(way->old, way->fresh);
      stars.close();
      EXPECT_EQ(mesh.tetrahedra.size(), idx(2 * (n - 2)));
      EXPECT_EQ(worst_quality(mesh), way->worst);
    }
    EXPECT_GT(changed, 20) << n;
  }
}

TEST(SolidReconnection, AFaceGivesWayToAnEdgeBetweenTheTips) {
  std::mt19937 random(8);
  int changed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SolidMesh mesh = around_an_axis(3, 0.4, 0.3, random);
    mesh.tetrahedra = {{2, 3, 4, 1}, {2, 4, 3, 0}};
    const double before = worst_quality(mesh);
    const std::optional<Reconnection> way = reconnection(SolidStars(mesh), 0);
    if (before <= 0.0 || !way)
      continue;
    ++changed;
    EXPECT_EQ(way->fresh.size(), 3u);
    expect_same_space(mesh, *way);
    EXPECT_GT(way->worst, before);
  }
  EXPECT_GT(changed, 20);
}

TEST(SolidReconnection, TheBoundaryStays) {
  std::mt19937 random(9);
  SolidMesh alone = around_an_axis(3, 2.0, 0.0, random);
  alone.tetrahedra.resize(1);
  EXPECT_FALSE(reconnection(SolidStars(alone), 0));
  for (int trial = 0; trial < 400; ++trial) {
    SolidMesh open = around_an_axis(5, 1.0, 0.5, random);
    open.tetrahedra.pop_back(); // an edge of the boundary: its ring is not closed
    for (std::size_t e = 0; e < open.tetrahedra.size(); ++e) {
      const std::optional<Reconnection> way = reconnection(SolidStars(open), e);
      EXPECT_TRUE(!way || way->old.size() == 2) << e; // a face inside may go
    }
  }
}

/// A cube with its twelve edges as lines and its six sides as patches.
PatchedSurface cube_with_edges() {
  PatchedSurface surface;
  surface.mesh = cube();
  const auto side_of = [&](const std::array<std::int32_t, 3>& corners) {
    for (Eigen::Index k = 0; k < 3; ++k)
      for (const int end : {0, 1})
        if (std::all_of(corners.begin(), corners.end(), [&](std::int32_t node) {
              return surface.mesh.points[idx(node)][k] == end;
            }))
          return static_cast<std::int32_t>(2 * k + end);
    return -1;
  };
  for (const auto& corners : surface.mesh.triangles)
    surface.patch.push_back(side_of(corners));
  for (std::int32_t k = 0; k < 3; ++k)
    for (const int u : {0, 1})
      for (const int v : {0, 1}) {
        const std::int32_t second = (k + 1) % 3, third = (k + 2) % 3;
        Vec3 from = Vec3::Zero();
        from[second] = u;
        from[third] = v;
        const Vec3 to = from + Vec3::Unit(k);
        surface.lines.push_back({{from, to}, {2 * second + u, 2 * third + v}});
      }
  surface.corners = {{0.5, 0.5, 1.0}};
  return surface;
}

TEST(SolidContraction, KeepsACubeItsEdgesAndItsCornersAndCoarsensWherePoorTetrahedraAre) {
  const PatchedSurface surface = cube_with_edges();
  const Vec3 fine_at(0.3, 0.0, 1.0); // on an edge
  PatchedSolid solid = mesh_patches(
      surface, [&](const Vec3& x) { return 0.05 + 0.5 * (x - fine_at).norm(); }, 1e5);
  const PatchedSolid before = solid;
  constexpr double wanted = 0.45;
  tidy(
      solid, surface.corners, [](const Vec3&) { return 0.5; }, wanted);
  EXPECT_LT(solid.mesh.tetrahedra.size(), before.mesh.tetrahedra.size());
  EXPECT_GT(worst_quality(solid.mesh), worst_quality(before.mesh));
  std::printf("%zu tetrahedra of quality %.3f -> %zu of %.3f\n", before.mesh.tetrahedra.size(),
              worst_quality(before.mesh), solid.mesh.tetrahedra.size(), worst_quality(solid.mesh));

  double volume = 0.0;
  for (const auto& corners : solid.mesh.tetrahedra) {
    EXPECT_GT(volume_of(solid.mesh, corners), 0.0);
    volume += volume_of(solid.mesh, corners);
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
  TriangleMesh boundary{solid.mesh.points, {}};
  for (const PatchedSolid::Facet& facet : solid.facets) {
    boundary.triangles.push_back(facet.corners);
    for (const std::int32_t node : facet.corners)
      EXPECT_EQ(solid.mesh.points[idx(node)][facet.patch / 2], facet.patch % 2);
  }
  EXPECT_TRUE(health(boundary).closed());
  EXPECT_NEAR(health(boundary).volume, 1.0, 1e-12);
  EXPECT_LT(solid.edges.size(), before.edges.size());
  std::vector<double> length(surface.lines.size(), 0.0);
  for (const PatchedSolid::LineEdge& edge : solid.edges) {
    const Vec3 &a = solid.mesh.points[idx(edge.corners[0])],
               &b = solid.mesh.points[idx(edge.corners[1])];
    const FeatureLine& line = surface.lines[idx(edge.line)];
    for (const Vec3& x : {a, b})
      EXPECT_LT((x - line.points[0]).cross(line.points[1] - line.points[0]).norm(), 1e-15);
    length[idx(edge.line)] += (b - a).norm();
  }
  for (const double sum : length)
    EXPECT_NEAR(sum, 1.0, 1e-14);
  EXPECT_TRUE(std::is_sorted(solid.edges.begin(), solid.edges.end(),
                             [](const auto& p, const auto& q) { return p.corners < q.corners; }));
  EXPECT_NE(std::find(solid.mesh.points.begin(), solid.mesh.points.end(), surface.corners[0]),
            solid.mesh.points.end());
}

} // namespace
} // namespace billet::geometry::solid_quality_test
