#include "mechanics/linear/elimination.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace billet::mechanics::elimination_test {
namespace {

struct Sample {
  BlockPattern pattern;
  Elimination elimination;
  explicit Sample(const Mesh& mesh)
      : pattern(block_pattern(mesh)), elimination(pattern, fill_reducing_order(pattern)) {}
};

std::vector<Mesh> meshes() {
  return {box_mesh({.kind = ElementKind::quad4, .cells = {1, 1, 1}}),
          box_mesh({.kind = ElementKind::quad8, .cells = {7, 5, 1}}),
          box_mesh({.kind = ElementKind::hex8, .cells = {5, 4, 6}})};
}

TEST(Elimination, orders_every_unknown_once) {
  for (const Mesh& mesh : meshes()) {
    const Sample sample(mesh);
    std::vector<Index> sorted(sample.elimination.order().begin(), sample.elimination.order().end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<Index> all(static_cast<std::size_t>(sample.pattern.n_dofs()));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(sorted, all);
  }
}

TEST(Elimination, hands_every_front_to_one_that_has_a_place_for_all_its_rows) {
  for (const Mesh& mesh : meshes()) {
    const Sample sample(mesh);
    const auto fronts = sample.elimination.fronts();
    Index column = 0;
    double entries = 0.0;
    for (std::size_t f = 0; f < fronts.size(); ++f) {
      const Front& front = fronts[f];
      EXPECT_EQ(front.first, column);
      column += front.columns;
      entries += 0.5 * front.columns * (front.columns + 1.0) + double(front.columns) * front.rows;
      const auto rows = sample.elimination.rows(front);
      EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
      if (rows.empty()) {
        EXPECT_EQ(front.parent, -1);
        continue;
      }
      ASSERT_GT(front.parent, static_cast<Index>(f));
      const Front& parent = fronts[idx(front.parent)];
      const auto in_parent = sample.elimination.rows(parent);
      for (const Index row : rows)
        EXPECT_TRUE((row >= parent.first && row < parent.first + parent.columns) ||
                    std::binary_search(in_parent.begin(), in_parent.end(), row));
    }
    EXPECT_EQ(column, sample.pattern.n_dofs());
    EXPECT_GE(entries, sample.elimination.entries()); // fronts are filled up with zeros
  }
}

TEST(Elimination, begins_with_what_stands_alone) {
  for (const Mesh& mesh : meshes()) {
    const BlockPattern pattern = block_pattern(mesh);
    std::vector<char> constrained(idx(pattern.n_dofs()));
    for (std::size_t i = 0; i < constrained.size(); i += 3)
      constrained[i] = 1;
    const auto n =
        static_cast<std::size_t>(std::count(constrained.begin(), constrained.end(), char{1}));
    const Elimination elimination(pattern, fill_reducing_order(pattern), constrained);
    for (std::size_t i = 0; i < constrained.size(); ++i)
      EXPECT_EQ(constrained[idx(elimination.order()[i])] != 0, i < n);
    for (const Front& front : elimination.fronts())
      if (idx(front.first) < n) {
        EXPECT_EQ(front.columns, 1);
        EXPECT_EQ(front.rows, 0);
      }
  }
}

/// The stack of complements depends on it: what a front takes from it lies on top.
TEST(Elimination, puts_children_just_before_their_parent) {
  for (const Mesh& mesh : meshes()) {
    const Sample sample(mesh);
    const auto fronts = sample.elimination.fronts();
    std::vector<std::size_t> waiting;
    for (std::size_t f = 0; f < fronts.size(); ++f) {
      while (!waiting.empty() && fronts[waiting.back()].parent == static_cast<Index>(f))
        waiting.pop_back();
      for (const std::size_t other : waiting)
        EXPECT_NE(fronts[other].parent, static_cast<Index>(f)) << "buried";
      if (fronts[f].rows > 0)
        waiting.push_back(f);
    }
    EXPECT_TRUE(waiting.empty());
  }
}

TEST(Elimination, takes_each_entry_of_the_lower_triangle_from_its_place) {
  for (const Mesh& mesh : meshes()) {
    const Sample sample(mesh);
    const OrderedTriangle& triangle = sample.elimination.triangle();
    const auto order = sample.elimination.order();
    for (std::size_t j = 0; j < order.size(); ++j)
      for (Index k = triangle.start[j]; k < triangle.start[j + 1]; ++k) {
        const Index i = triangle.rows[idx(k)];
        EXPECT_GE(i, static_cast<Index>(j));
        const Index from = std::min(order[idx(i)], order[j]);
        EXPECT_EQ(sample.pattern.columns[idx(triangle.entries[idx(k)])],
                  std::max(order[idx(i)], order[j]));
        EXPECT_GE(triangle.entries[idx(k)], sample.pattern.row_start[idx(from)]);
        EXPECT_LT(triangle.entries[idx(k)], sample.pattern.row_start[idx(from) + 1]);
      }
  }
}

} // namespace
} // namespace billet::mechanics::elimination_test
