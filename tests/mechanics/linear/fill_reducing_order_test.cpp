#include "mechanics/linear/linear_solver.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::mechanics::fill_reducing_order_test {
namespace {

TEST(FillReducingOrder, is_a_permutation_that_keeps_the_unknowns_of_a_node_together) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::hex20}) {
    const BlockPattern pattern = block_pattern(box_mesh({.kind = kind, .cells = {3, 4, 2}}));
    const auto order = fill_reducing_order(pattern);
    std::vector<Index> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(static_cast<Index>(sorted.size()), pattern.n_dofs());
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      ASSERT_EQ(sorted[static_cast<std::size_t>(i)], i);
    for (std::size_t i = 0; i < order.size(); i += static_cast<std::size_t>(pattern.dim))
      EXPECT_EQ(order[i] + 1, order[i + 1]);
    EXPECT_EQ(order, fill_reducing_order(pattern)); // repeats
  }
}

} // namespace
} // namespace billet::mechanics::fill_reducing_order_test
