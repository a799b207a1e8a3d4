// Meshes of bodies: they fill the surface, keep its edges, have no flat tetrahedra and repeat.

#include "geometry/base/error.h"
#include "geometry/mesh3d/mesher_3d.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/studded_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace billet::geometry::mesher_3d_test {
namespace {

/// An L of thickness 1: 3 x 3 with arms 1 wide.
TriangleMesh angle_section() {
  const std::vector<Vec2> outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const Vec2& p : outline)
      mesh.points.emplace_back(p.x(), p.y(), z);
  const std::vector<std::array<std::int32_t, 3>> face{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& [a, b, c] : face) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::int32_t i = 0; i < 6; ++i) {
    const std::int32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

struct Named {
  std::string name;
  TriangleMesh surface;
  double size;
  double volume_error; ///< allowed
};

std::vector<Named> bodies() {
  return {{"cube", cube(), 0.3, 1e-12}, {"angle", angle_section(), 0.4, 1e-12}};
}

TEST(SolidMesh, FillsTheBodyWithGoodTetrahedra) {
  for (const Named& body : bodies()) {
    const SolidMesh mesh = mesh_solid(body.surface, {body.size});
    const double exact = health(body.surface).volume;
    std::printf("%-8s %5zu tetrahedra, smallest dihedral angle %.1f deg, volume %+.1e\n",
                body.name.c_str(), mesh.tetrahedra.size(), smallest_dihedral(mesh),
                volume(mesh) / exact - 1.0);
    EXPECT_GE(smallest_dihedral(mesh), 10.0) << body.name;
    EXPECT_NEAR(volume(mesh), exact, body.volume_error * exact) << body.name;
    for (const Vec3& corner : body.surface.points) {
      double closest = 1e300;
      for (const Vec3& p : mesh.points)
        closest = std::min(closest, (p - corner).norm());
      EXPECT_LT(closest, 1e-12) << body.name;
    }
  }
}

TEST(SolidMesh, IsOneBodyWithoutGaps) {
  for (const Named& body : bodies()) {
    const SolidMesh mesh = mesh_solid(body.surface, {body.size});
    std::map<std::set<std::int32_t>, int> faces;
    for (const auto& [a, b, c, d] : mesh.tetrahedra)
      for (const auto& face : {std::set{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}})
        ++faces[face];
    double area = 0.0;
    for (const auto& [face, count] : faces) {
      ASSERT_LE(count, 2) << body.name;
      if (count == 2)
        continue;
      std::vector<Vec3> p;
      for (const std::int32_t i : face)
        p.push_back(mesh.points[static_cast<std::size_t>(i)]);
      area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    }
    const double exact = health(body.surface).area;
    EXPECT_NEAR(area, exact, body.volume_error * exact) << body.name;
  }
}

TEST(SolidMesh, RepeatsToTheBit) {
  for (const Named& body : bodies()) {
    const SolidMesh mesh = mesh_solid(body.surface, {body.size});
    const SolidMesh again = mesh_solid(body.surface, {body.size});
    EXPECT_EQ(mesh.points, again.points) << body.name;
    EXPECT_EQ(mesh.tetrahedra, again.tetrahedra) << body.name;
  }
}

TEST(SolidMesh, PassesOverDetails) {
  const TriangleMesh block = studded_block(1, 0.3);
  const double exact = health(block).volume;
  const SolidMesh fine = mesh_solid(block, {4.0});
  const SolidMesh coarse = mesh_solid(block, {.size = 4.0, .details = 0.5});
  std::printf("studs: %zu tetrahedra, %zu without, volume %+.1e, angle %.1f deg\n",
              fine.tetrahedra.size(), coarse.tetrahedra.size(), volume(coarse) / exact - 1.0,
              smallest_dihedral(coarse));
  EXPECT_LT(3 * coarse.tetrahedra.size(), 2 * fine.tetrahedra.size());
  EXPECT_NEAR(volume(coarse), exact, 5e-3 * exact);
  EXPECT_GE(smallest_dihedral(coarse), 5.0);
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(20, 0, 6), Vec3(20, 20, 6)}) // edges are kept
    EXPECT_TRUE(std::any_of(coarse.points.begin(), coarse.points.end(),
                            [&](const Vec3& p) { return (p - corner).norm() < 1e-9; }));
}

TEST(SolidMesh, RefusesWhatIsNoBody) {
  TriangleMesh open = cube();
  open.triangles.pop_back();
  EXPECT_THROW((void)mesh_solid(open, {0.3}), Error);
  EXPECT_THROW((void)mesh_solid(flipped(cube()), {0.3}), Error);
  EXPECT_THROW((void)mesh_solid(cube(), {0.0}), Error);
  EXPECT_THROW((void)mesh_solid(cube(), {1e-4}), Error);
}

} // namespace
} // namespace billet::geometry::mesher_3d_test
