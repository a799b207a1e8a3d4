#include "geometry/repair/mesh_repair.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace billet::geometry::mesh_repair_test {
namespace {

constexpr double tolerance = 1e-4;
constexpr double precision = 1e-9;

TriangleMesh two_cubes(const Vec3& apart) {
  TriangleMesh mesh = cube();
  for (const TriangleMesh other = cube(); const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  for (const TriangleMesh other = cube(); const Vec3& p : other.points)
    mesh.points.emplace_back(p + apart);
  return mesh;
}

TEST(MeshRepair, ASoundSurfaceIsLeftAsItIs) {
  for (const TriangleMesh& mesh : {cube(), angle_bar(), spiky(7)}) {
    TriangleMesh mended = mesh;
    const Repaired result = repair(mended, tolerance, precision);
    EXPECT_TRUE(result.done.notes().empty());
    EXPECT_EQ(mended.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(mended.points.size(), mesh.points.size());
    EXPECT_NEAR(health(mended).volume, health(mesh).volume, 1e-12);
    ASSERT_EQ(result.parts.list.size(), 1U);
    EXPECT_NEAR(result.parts.list[0].volume, health(mesh).volume, 1e-12);
  }
}

TEST(MeshRepair, CracksWithinTheToleranceAreStitchedAndNoPointMovesFarther) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-0.25 * tolerance, 0.25 * tolerance);
  TriangleMesh mesh = soup(sphere_mesh(8));
  const double volume = health(sphere_mesh(8)).volume;
  for (Vec3& p : mesh.points)
    p += Vec3(off(random), off(random), off(random));
  const Repaired result = repair(mesh, tolerance, precision);
  const MeshHealth h = health(mesh);
  EXPECT_TRUE(h.closed());
  EXPECT_EQ(mesh.points.size(), sphere_mesh(8).points.size());
  EXPECT_NEAR(h.volume, volume, h.area * tolerance);
  EXPECT_GT(result.done.stitching.largest_move, 0.0);
  EXPECT_LE(result.done.stitching.largest_move, tolerance);
}

TEST(MeshRepair, CracksBeyondTheToleranceAreLeft) {
  TriangleMesh mesh = cube();
  const auto copy = static_cast<std::int32_t>(mesh.points.size());
  const Vec3 off = corner(mesh, 5, 0) + Vec3::Constant(10.0 * tolerance);
  mesh.points.push_back(off);
  mesh.triangles[5][0] = copy;
  EXPECT_EQ(repair(mesh, tolerance, precision).done.stitching.merged_points, 0);
  EXPECT_EQ(health(mesh).border_loops, 1);
}

TEST(MeshRepair, FineBorderEdgesDoNotCollapse) {
  TriangleMesh mesh = sheet(5, [](double, double) { return 0.0; });
  const Repaired result = repair(mesh, 0.9, precision); // edges are 0.2 long
  EXPECT_TRUE(result.done.notes().empty());
  EXPECT_EQ(mesh.triangles.size(), 50U);
}

TEST(MeshRepair, AnEdgeIsSplitWhereATJunctionLiesOnIt) {
  TriangleMesh mesh = cube();
  const std::array<std::int32_t, 3> t = mesh.triangles[0];
  mesh.points.emplace_back(0.6 * mesh.points[static_cast<std::size_t>(t[0])] +
                           0.4 * mesh.points[static_cast<std::size_t>(t[1])]);
  mesh.triangles[0] = {t[0], 8, t[2]};
  mesh.triangles.push_back({8, t[1], t[2]});
  EXPECT_EQ(health(mesh).border_edges, 3);
  const Repaired result = repair(mesh, tolerance, precision);
  EXPECT_EQ(result.done.stitching.t_junctions, 1);
  EXPECT_TRUE(health(mesh).closed());
  EXPECT_NEAR(health(mesh).volume, 1.0, 1e-12);
}

TEST(MeshRepair, TheSmallerAreaIsTurnedToFollowTheLarger) {
  TriangleMesh mesh = sphere_mesh(9);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 4)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const Repaired result = repair(mesh, tolerance, precision);
  EXPECT_EQ(result.done.turned_triangles, 72);
  EXPECT_NEAR(health(mesh).volume, health(sphere_mesh(9)).volume, 1e-12);
}

TEST(MeshRepair, AWholeBodyInsideOutIsLeftAndOneBesideASoundOneIsTurned) {
  TriangleMesh alone = flipped(cube());
  EXPECT_EQ(repair(alone, tolerance, precision).done.turned_shells, 0);
  EXPECT_TRUE(health(alone).inside_out());
  TriangleMesh pair = two_cubes({3, 0, 0});
  for (std::size_t t = 0; t < 12; ++t)
    std::swap(pair.triangles[t][0], pair.triangles[t][1]);
  EXPECT_EQ(repair(pair, tolerance, precision).done.turned_shells, 1);
  EXPECT_NEAR(health(pair).volume, 2.0, 1e-12);
}

TEST(MeshRepair, ACavityStaysOneAndIsTurnedWithItsBody) {
  TriangleMesh mesh = two_cubes(Vec3::Zero());
  for (std::size_t i = 8; i < 16; ++i)
    mesh.points[i] = 0.5 * mesh.points[i] + Vec3::Constant(0.25);
  for (std::size_t t = 12; t < 24; ++t)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  TriangleMesh inverted = flipped(mesh);
  const Repaired result = repair(mesh, tolerance, precision);
  EXPECT_TRUE(result.done.notes().empty());
  EXPECT_EQ(result.parts.list.at(1).in, std::vector<std::int32_t>{0});
  EXPECT_NEAR(health(mesh).volume, 1.0 - 0.125, 1e-12);

  const TriangleMesh beside = cube();
  for (const auto& t : beside.triangles)
    inverted.triangles.push_back({t[0] + 16, t[1] + 16, t[2] + 16});
  for (const Vec3& p : beside.points)
    inverted.points.emplace_back(p + Vec3(4, 0, 0));
  EXPECT_EQ(repair(inverted, tolerance, precision).done.turned_shells, 1);
  EXPECT_NEAR(health(inverted).volume, 2.0 - 0.125, 1e-12);
}

TEST(MeshRepair, BodiesThatTouchInAPointOrAnEdgeAreParted) {
  for (const auto& [apart, added] : {std::pair(Vec3(1, 1, 1), 1), std::pair(Vec3(1, 1, 0), 2)}) {
    TriangleMesh mesh = two_cubes(apart);
    EXPECT_EQ(repair(mesh, tolerance, precision).done.parted_points, added);
    const MeshHealth h = health(mesh);
    EXPECT_TRUE(h.closed());
    EXPECT_EQ(h.components, 2);
    EXPECT_EQ(h.non_manifold_vertices, 0);
    EXPECT_NEAR(h.volume, 2.0, 1e-12);
  }
}

TEST(MeshRepair, ADoubledFaceGoesAndADoubledWallGoesAltogether) {
  TriangleMesh face = cube();
  face.triangles.push_back({face.triangles[4][0], face.triangles[4][2], face.triangles[4][1]});
  EXPECT_EQ(repair(face, tolerance, precision).done.opposite_triangles, 1);
  EXPECT_NEAR(health(face).volume, 1.0, 1e-12);

  TriangleMesh glued = two_cubes(Vec3::Zero());
  for (std::size_t i = 8; i < 16; ++i) // the mirror image beyond x = 1
    glued.points[i].x() = 2.0 - glued.points[i].x();
  for (std::size_t t = 12; t < 24; ++t)
    std::swap(glued.triangles[t][0], glued.triangles[t][1]);
  EXPECT_EQ(repair(glued, tolerance, precision).done.opposite_triangles, 4);
  EXPECT_TRUE(health(glued).closed());
  EXPECT_EQ(health(glued).components, 1);
  EXPECT_NEAR(health(glued).volume, 2.0, 1e-12);
}

TEST(MeshRepair, WhatCannotBeMendedIsLeftForTheComplaints) {
  TriangleMesh fin = cube();
  fin.points.emplace_back(0.5, -1.0, -1.0);
  fin.triangles.push_back({0, 1, 8});
  repair(fin, tolerance, precision);
  EXPECT_EQ(health(fin).non_manifold_edges, 1);
  TriangleMesh half = sheet(4, [](double, double) { return 0.0; });
  for (std::size_t t = 0; t < 16; ++t)
    std::swap(half.triangles[t][0], half.triangles[t][1]);
  EXPECT_EQ(repair(half, tolerance, precision).done.turned_triangles, 0);
  EXPECT_EQ(complaints(health(half), "").size(), 1U);
}

} // namespace
} // namespace billet::geometry::mesh_repair_test
