#include "mechanics/mesh/mesh_generators.h"
#include "mechanics/mesh/simplex_cells.h"
#include "tests/support/patch.h"
#include "tests/support/total_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace billet::mechanics::simplex_cells_test {
namespace {

TEST(SimplexCells, fill_the_cells_and_match_whatever_the_order) {
  for (const ElementKind kind : {ElementKind::tri6, ElementKind::tet10}) {
    const bool solid = dimension(kind) == 3;
    const Mesh blocks =
        solid ? support::solid_patch(ElementKind::hex8) : support::plane_patch(ElementKind::quad4);
    std::vector<int> rank(blocks.points.size());
    std::iota(rank.begin(), rank.end(), 0);
    const std::size_t outside = boundary_faces(blocks).size() * (solid ? 2 : 1);
    support::Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
      for (std::size_t i = rank.size(); i > 1; --i)
        std::swap(rank[i - 1],
                  rank[static_cast<std::size_t>(random.number(0.0, static_cast<double>(i)))]);
      const auto corners = cut_into_simplices(dimension(kind), blocks.cells, rank);
      const Mesh mesh = quadratic_mesh(kind, blocks.points, corners);
      // Hexahedra with warped sides may not be cut in any way.
      EXPECT_TRUE(solid || check_mesh(mesh, "", false).empty());
      EXPECT_EQ(mesh.n_elements(), blocks.n_elements() * (solid ? 6 : 2));
      EXPECT_NEAR(support::total_measure(mesh), solid ? 1.0 : 0.24 * 0.12, 1e-14);
      // Sides that do not match would count as boundary.
      EXPECT_EQ(boundary_faces(mesh).size(), outside);
    }
  }
}

TEST(SimplexCells, of_equal_ranks_the_lower_number_is_cut_from) {
  const std::vector<Index> quad{3, 1, 2, 0};
  EXPECT_EQ(cut_into_simplices(2, quad), (std::vector<Index>{0, 3, 1, 0, 1, 2}));
  EXPECT_EQ(cut_into_simplices(2, quad, std::vector<int>{1, 0, 0, 0}),
            (std::vector<Index>{1, 2, 0, 1, 0, 3}));
}

} // namespace
} // namespace billet::mechanics::simplex_cells_test
