// Which process owns which nodes.

#include "mechanics/linear/distributed/node_parts.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace billet::mechanics::node_parts_test {
namespace {

BlockPattern pattern_of(ElementKind kind, int cells) {
  return block_pattern(
      box_mesh({kind, Vec3::Zero(), Vec3(2.0, 1.0, 1.0), {2 * cells, cells, cells}}));
}

/// Couplings between nodes of different parts, of all couplings.
double cut(const BlockPattern& pattern, const NodeParts& parts) {
  std::vector<int> part(parts.order.size());
  for (std::size_t p = 0; p + 1 < parts.start.size(); ++p)
    for (Index i = parts.start[p]; i < parts.start[p + 1]; ++i)
      part[idx(parts.order[idx(i)])] = static_cast<int>(p);
  std::size_t between = 0;
  for (Index a = 0; a < pattern.n_nodes(); ++a)
    for (Index k = pattern.neighbour_start[idx(a)]; k < pattern.neighbour_start[idx(a) + 1]; ++k)
      between += part[idx(a)] != part[idx(pattern.neighbours[idx(k)])] ? 1 : 0;
  return static_cast<double>(between) / static_cast<double>(pattern.neighbours.size());
}

TEST(NodeParts, hold_every_node_once_in_compact_parts_of_the_same_size) {
  // Quadratic elements number corners first: equal ranges of numbers would not be compact.
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20}) {
    const BlockPattern pattern = pattern_of(kind, 8);
    for (const int n_parts : {1, 2, 4, 7}) {
      const NodeParts parts = node_parts(pattern, n_parts);
      ASSERT_EQ(parts.start.size(), idx(n_parts) + 1);
      EXPECT_EQ(parts.start.back(), pattern.n_nodes());
      std::vector<Index> sorted = parts.order, all(sorted.size());
      std::sort(sorted.begin(), sorted.end());
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(sorted, all);
      for (std::size_t p = 0; p < idx(n_parts); ++p) {
        const auto begin = parts.order.begin() + parts.start[p];
        const auto end = parts.order.begin() + parts.start[p + 1];
        EXPECT_TRUE(std::is_sorted(begin, end));
        const double share = static_cast<double>(end - begin) * n_parts / pattern.n_nodes();
        EXPECT_GT(share, 0.7);
        EXPECT_LT(share, 1.3);
      }
      EXPECT_LT(cut(pattern, parts), n_parts == 1 ? 1e-12 : 0.05 * n_parts);
    }
  }
}

TEST(NodeParts, may_be_empty_where_there_are_more_processes_than_nodes) {
  const BlockPattern pattern = pattern_of(ElementKind::hex8, 1); // 12 nodes
  const NodeParts parts = node_parts(pattern, 16);
  EXPECT_EQ(parts.start.size(), 17U);
  EXPECT_EQ(parts.start.back(), 12);
}

} // namespace
} // namespace billet::mechanics::node_parts_test
