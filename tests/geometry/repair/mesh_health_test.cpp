#include "geometry/repair/mesh_health.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace billet::geometry::mesh_health_test {
namespace {

TEST(MeshHealth, AspectRatiosAreTheLongestSideOverTheSmallestHeight) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_NEAR(health(mesh).worst_aspect, 2.0 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(health(mesh).needles, 0);
  mesh.points[2] = {0.5, 1e-5, 0};
  EXPECT_NEAR(health(mesh).worst_aspect, 1e5, 1e-6);
  EXPECT_EQ(health(mesh).needles, 1);
  mesh.points[2] = {0.5, 0, 0};
  EXPECT_EQ(health(mesh).worst_aspect, std::numeric_limits<double>::infinity());
  EXPECT_EQ(health(mesh).degenerate_triangles, 1);
}

TEST(MeshHealth, EachRimIsALoopAlsoWhereTwoMeet) {
  TriangleMesh mesh = cube();
  EXPECT_EQ(health(mesh).border_loops, 0);
  mesh.triangles.erase(mesh.triangles.begin());
  EXPECT_EQ(health(mesh).border_loops, 1);
  EXPECT_TRUE(health(mesh).border_at.has_value());
  TriangleMesh sheets; // two triangles that share a point
  sheets.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  sheets.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(health(sheets).border_loops, 2);
  EXPECT_EQ(health(sheets).non_manifold_vertices, 1);
  EXPECT_EQ(*health(sheets).non_manifold_vertex_at, Vec3::Zero());
}

TEST(MeshHealth, FeatureEdgesAreSharperThanTheAngle) {
  EXPECT_EQ(health(cube()).feature_edges, 12);
  EXPECT_EQ(health(cube(), 89.0).feature_edges, 12);
  EXPECT_EQ(health(cube(), 91.0).feature_edges, 0);
  EXPECT_EQ(health(sphere_mesh(20)).feature_edges, 0);
  EXPECT_GT(health(sphere_mesh(20), 5.0).feature_edges, 0);
}

} // namespace
} // namespace billet::geometry::mesh_health_test
