#include "mechanics/mesh/mesh_edges.h"

#include <gtest/gtest.h>

#include <set>

namespace billet::mechanics::mesh_edges_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                               ElementKind::tet10};

TEST(MeshEdges, a_quadratic_cell_has_a_node_for_each_corner_and_each_edge) {
  for (const ElementKind kind : all_kinds) {
    const auto n_edges = static_cast<int>(element_edges(kind).size());
    EXPECT_EQ(nodes_per_element(kind),
              corners_per_element(kind) + (is_quadratic(kind) ? n_edges : 0))
        << name(kind);
  }
}

TEST(MeshEdges, each_corner_has_as_many_edges_as_the_cell_has_dimensions) {
  for (const ElementKind kind : all_kinds) {
    std::multiset<int> corners;
    for (const auto& [a, b] : element_edges(kind)) {
      EXPECT_NE(a, b);
      corners.insert({a, b});
    }
    for (int corner = 0; corner < corners_per_element(kind); ++corner)
      EXPECT_EQ(corners.count(corner), static_cast<std::size_t>(dimension(kind))) << name(kind);
  }
}

} // namespace
} // namespace billet::mechanics::mesh_edges_test
