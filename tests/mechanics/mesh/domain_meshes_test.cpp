#include "mechanics/mesh/domain_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/total_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::mechanics::domain_meshes_test {
namespace {

// A quarter of a disc of radius 5 with a hole of radius 1.
geometry::Profile quarter_ring() {
  return {{1, 0}, {{{5, 0}}, {{0, 5}, 5.0}, {{0, 1}}, {{1, 0}, -1.0}}, true};
}

TEST(DomainMeshes, TrianglesFollowTheArcsAndAreSound) {
  for (const double size : {0.4, 1.0, 5.0}) {
    const Mesh mesh = triangle_mesh(geometry::mesh_outline(quarter_ring(), size));
    EXPECT_TRUE(check_mesh(mesh, "", true).empty());
    const auto qualities = element_qualities(mesh, mesh.points);
    EXPECT_GT(*std::min_element(qualities.begin(), qualities.end()), 0.2);
    const double exact = std::numbers::pi / 4.0 * 24.0;
    EXPECT_NEAR(support::total_measure(mesh), exact, 2e-4 * exact);
    for (const Face& face : boundary_faces(mesh))
      for (const Index node : face.nodes) {
        const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
        const double off = std::min(
            {std::abs(p.norm() - 5.0), std::abs(p.norm() - 1.0), std::abs(p.x()), std::abs(p.y())});
        EXPECT_LT(off, 1e-12);
      }
  }
}

TEST(DomainMeshes, SegmentsAreNodeSets) {
  const Mesh mesh = triangle_mesh(geometry::mesh_outline(quarter_ring(), 0.5));
  ASSERT_EQ(mesh.node_sets.size(), 4U);
  std::size_t on_outer = 0;
  for (const Vec3& p : mesh.points)
    on_outer += std::abs(p.norm() - 5.0) < 1e-9 ? 1 : 0;
  EXPECT_EQ(mesh.node_sets.at("segment-2").size(), on_outer);
  for (const Index node : mesh.node_sets.at("segment-1"))
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(node)].y(), 0.0);
  for (const Index node : mesh.node_sets.at("segment-3"))
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(node)].x(), 0.0);
}

TEST(DomainMeshes, TetrahedraFillTheBody) {
  const Mesh mesh = tetrahedron_mesh(geometry::mesh_solid(geometry::cube(), {0.4}));
  EXPECT_TRUE(check_mesh(mesh, "", false).empty());
  EXPECT_NEAR(support::total_measure(mesh), 1.0, 1e-12);
}

} // namespace
} // namespace billet::mechanics::domain_meshes_test
