#include "geometry/triangles/triangle_mesh.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::geometry::triangle_mesh_test {
namespace {

constexpr double rounding = 1e-12;

TEST(TriangleMesh, WeldingASoupGivesTheClosedBodyBack) {
  TriangleMesh mesh = soup(spiky(6));
  EXPECT_FALSE(health(mesh).closed());
  const CleanUp done = clean_up(mesh, 0.0);
  EXPECT_EQ(mesh.points.size(), spiky(6).points.size());
  EXPECT_EQ(done.welded_points,
            static_cast<std::int64_t>(3 * mesh.triangles.size() - mesh.points.size()));
  EXPECT_EQ(done.degenerate_triangles + done.duplicate_triangles + done.slivers, 0);
  EXPECT_TRUE(health(mesh).closed());
}

TEST(TriangleMesh, PlusAndMinusZeroAreTheSamePoint) {
  TriangleMesh mesh;
  mesh.points = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, -1, 0}, {1, 0, -0.0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(clean_up(mesh, 0.0).welded_points, 2);
  EXPECT_EQ(health(mesh).border_edges, 4);
}

TEST(TriangleMesh, HealthOfACubeIsItsVolumeAreaAndBox) {
  const MeshHealth h = health(cube());
  EXPECT_TRUE(h.closed());
  EXPECT_FALSE(h.inside_out());
  EXPECT_NEAR(h.volume, 1.0, rounding);
  EXPECT_NEAR(h.area, 6.0, rounding);
  EXPECT_EQ(h.components, 1);
  EXPECT_EQ(h.bounds.low, Vec3::Zero());
  EXPECT_EQ(h.bounds.high, Vec3::Ones());
  EXPECT_TRUE(complaints(h, "").empty());
  EXPECT_TRUE(health(flipped(cube())).inside_out());
}

TEST(TriangleMesh, TwoBodiesAreTwoComponents) {
  TriangleMesh mesh = cube();
  for (const TriangleMesh other = cube(); const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  for (const TriangleMesh other = cube(); const Vec3& p : other.points)
    mesh.points.emplace_back(p + Vec3(5, 0, 0));
  EXPECT_EQ(health(mesh).components, 2);
  EXPECT_NEAR(health(mesh).volume, 2.0, rounding);
}

TEST(TriangleMesh, DegenerateAndDuplicateTrianglesAreDroppedAndCounted) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 0, 1});
  const std::array<std::int32_t, 3> t = mesh.triangles[3];
  mesh.triangles.push_back({t[1], t[2], t[0]});
  EXPECT_EQ(health(mesh).degenerate_triangles, 1);
  EXPECT_EQ(health(mesh).duplicate_triangles, 1);
  const CleanUp done = clean_up(mesh, 0.0);
  EXPECT_EQ(done.degenerate_triangles, 1);
  EXPECT_EQ(done.duplicate_triangles, 1);
  EXPECT_TRUE(health(mesh).closed());
  EXPECT_EQ(mesh.triangles.size(), 12U);
}

TEST(TriangleMesh, ATriangleWithoutHeightIsMergedWithItsNeighbourAndTheBodyStaysClosed) {
  // One side of a cube split at a point on a diagonal's edge: (0,0,0)-(1,0,0) gets a middle point
  // that only one of its two faces knows, and a triangle without area closes the crack.
  TriangleMesh mesh = cube();
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0.5, 0.0, 0.0);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& t : mesh.triangles) {
    bool split = false;
    for (std::size_t i = 0; i < 3 && !split; ++i)
      if (t[i] == 0 && t[(i + 1) % 3] == 1) {
        triangles.push_back({0, middle, t[(i + 2) % 3]});
        triangles.push_back({middle, 1, t[(i + 2) % 3]});
        triangles.push_back({0, 1, middle});
        split = true;
      }
    if (!split)
      triangles.push_back(t);
  }
  mesh.triangles = triangles;
  EXPECT_EQ(health(mesh).degenerate_triangles, 1);
  const CleanUp done = clean_up(mesh, 0.0);
  EXPECT_EQ(done.slivers, 1);
  const MeshHealth h = health(mesh);
  EXPECT_TRUE(h.closed());
  EXPECT_EQ(h.degenerate_triangles, 0);
  EXPECT_NEAR(h.volume, 1.0, rounding);
  EXPECT_NEAR(h.area, 6.0, rounding);
}

TEST(TriangleMesh, DamageIsReportedWithItsPlace) {
  TriangleMesh fin = cube(); // a third triangle on the edge from (0,0,0) to (1,0,0)
  fin.points.emplace_back(0.5, -1.0, -1.0);
  fin.triangles.push_back({0, 1, 8});
  const MeshHealth h = health(fin);
  EXPECT_EQ(h.non_manifold_edges, 1);
  EXPECT_EQ(*h.non_manifold_at, Vec3(0.5, 0, 0));
  EXPECT_FALSE(h.closed());
  ASSERT_EQ(complaints(h, "die.stl").size(), 1U);
  EXPECT_NE(complaints(h, "die.stl")[0].text().find("(0.5, 0, 0)"), std::string::npos);

  TriangleMesh turned = cube();
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  EXPECT_EQ(health(turned).inconsistent_edges, 3);
  EXPECT_EQ(complaints(health(turned), "").size(), 1U);

  TriangleMesh hole = cube();
  hole.triangles.pop_back();
  EXPECT_EQ(health(hole).border_edges, 3);
  EXPECT_EQ(health(hole).volume, 0.0);
  EXPECT_TRUE(complaints(health(hole), "").empty()); // open surfaces are legal
}

TEST(TriangleMesh, TwoSheetsBackToBackAreRefused) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(health(mesh).duplicate_triangles, 1);
  EXPECT_EQ(complaints(health(mesh), "").size(), 1U);
}

TEST(TriangleMesh, TheVolumeSurvivesALargeOffset) {
  TriangleMesh mesh = sphere_mesh(20);
  const double volume = health(mesh).volume;
  for (Vec3& p : mesh.points)
    p += Vec3(1e6, -1e6, 1e6);
  EXPECT_NEAR(health(mesh).volume, volume, 1e-8); // coordinates are rounded to 1e-10
  EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi, 0.05);
}

} // namespace
} // namespace billet::geometry::triangle_mesh_test
