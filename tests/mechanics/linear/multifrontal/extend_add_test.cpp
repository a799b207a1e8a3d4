#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multifrontal/extend_add.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace billet::mechanics::extend_add_test {
namespace {

/// Unknowns of a front in the order of elimination: its columns', then its rows'.
std::vector<Index> unknowns_of(const Elimination& elimination, const Front& front) {
  std::vector<Index> unknowns(idx(front.columns));
  std::iota(unknowns.begin(), unknowns.end(), front.first);
  const auto rows = elimination.rows(front);
  unknowns.insert(unknowns.end(), rows.begin(), rows.end());
  return unknowns;
}

/// Numbers of a lower trapezoid by columns, and between them some that must stay.
std::vector<float> triangle(support::Random& random, std::size_t rows, std::size_t columns) {
  std::vector<float> values;
  for (const double number : random.list(padded(rows) * columns, 1.0))
    values.push_back(static_cast<float>(number));
  return values;
}

/// What a child adds to its parent, entry by entry, and that nothing else changes.
void expect_sums(const Elimination& elimination, std::size_t child, support::Random& random) {
  const ExtendAdd extend_add(elimination);
  const Front& front = elimination.fronts()[child];
  const Front& parent = elimination.fronts()[idx(front.parent)];
  const std::vector<Index> there = unknowns_of(elimination, parent);
  const auto columns = idx(parent.columns), rows = there.size();
  const std::vector<float> complement = triangle(random, idx(front.rows), idx(front.rows));
  const std::vector<float> panel_before = triangle(random, rows, columns);
  const std::vector<float> rest_before = triangle(random, rows - columns, rows - columns);
  std::vector<float> panel = panel_before, rest = rest_before;
  extend_add.to_panel(child, complement.data(), {panel.data(), rows, columns});
  extend_add.to_complement(child, complement.data(), {panel.data(), rows, columns}, rest.data());
  std::vector<float> panel_after = panel_before, rest_after = rest_before;
  const auto unknowns = elimination.rows(front);
  const auto place = [&](Index unknown) {
    return static_cast<std::size_t>(std::lower_bound(there.begin(), there.end(), unknown) -
                                    there.begin());
  };
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    for (std::size_t i = j; i < unknowns.size(); ++i) {
      const std::size_t row = place(unknowns[i]), column = place(unknowns[j]);
      const float more = complement[j * padded(unknowns.size()) + i];
      if (column < columns)
        panel_after[column * padded(rows) + row] += more;
      else
        rest_after[(column - columns) * padded(rows - columns) + row - columns] += more;
    }
  EXPECT_EQ(panel, panel_after) << "front " << child;
  EXPECT_EQ(rest, rest_after) << "front " << child;
}

void expect_sums(const Mesh& mesh, Index alone_every) {
  const BlockPattern pattern = block_pattern(mesh);
  std::vector<char> constrained(idx(pattern.n_dofs()), 0);
  for (Index i = 0; alone_every > 0 && i < pattern.n_dofs(); i += alone_every)
    constrained[idx(i)] = 1;
  const Elimination elimination(pattern, fill_reducing_order(pattern), constrained);
  support::Random random(11);
  int children = 0;
  for (std::size_t f = 0; f < elimination.fronts().size(); ++f)
    if (elimination.fronts()[f].parent >= 0) {
      expect_sums(elimination, f, random);
      ++children;
    }
  EXPECT_GT(children, 4);
}

TEST(ExtendAdd, adds_a_childs_complement_to_its_parent_and_touches_nothing_else) {
  expect_sums(box_mesh({.kind = ElementKind::quad4, .cells = {15, 12, 1}}), 0);
  expect_sums(box_mesh({.kind = ElementKind::quad8, .cells = {6, 7, 1}}), 0);
  expect_sums(box_mesh({.kind = ElementKind::hex8, .cells = {5, 4, 6}}), 0);
}

TEST(ExtendAdd, does_so_where_some_unknowns_of_nodes_are_alone) {
  for (const Index every : {3, 7}) {
    expect_sums(box_mesh({.kind = ElementKind::quad4, .cells = {15, 12, 1}}), every);
    expect_sums(box_mesh({.kind = ElementKind::hex8, .cells = {5, 4, 6}}), every);
  }
}

} // namespace
} // namespace billet::mechanics::extend_add_test
