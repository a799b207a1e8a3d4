#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multifrontal/front_assembly.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace billet::mechanics::front_assembly_test {
namespace {

/// Of the matrix, from the row that the triangle takes it from.
double entry(const SparseMatrix& A, Index a, Index b) {
  return A.values[idx(A.pattern->entry(std::min(a, b), std::max(a, b)))];
}

bool coupled(const BlockPattern& pattern, Index a, Index b) {
  const Index node = a / pattern.dim, other = b / pattern.dim;
  const auto first = pattern.neighbours.begin() + pattern.neighbour_start[idx(node)];
  const auto last = pattern.neighbours.begin() + pattern.neighbour_start[idx(node) + 1];
  return std::binary_search(first, last, other);
}

/// Every panel against its columns of the matrix, entry by entry.
void expect_columns_of_matrix(const Mesh& mesh, Index alone_every) {
  support::Random random(7);
  const BlockPattern pattern = block_pattern(mesh);
  std::vector<char> constrained(idx(pattern.n_dofs()), 0);
  for (Index i = 0; alone_every > 0 && i < pattern.n_dofs(); i += alone_every)
    constrained[idx(i)] = 1;
  const Elimination elimination(pattern, fill_reducing_order(pattern), constrained);
  const SparseMatrix A{&pattern, random.list(pattern.n_entries(), 1.0)};
  const FrontAssembly assembly(elimination);
  constexpr double scale = 0.5;
  const auto fronts = elimination.fronts();
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const Front& front = fronts[f];
    std::vector<Index> unknowns;
    for (Index j = 0; j < front.columns; ++j)
      unknowns.push_back(elimination.order()[idx(front.first + j)]);
    for (const Index row : elimination.rows(front))
      unknowns.push_back(elimination.order()[idx(row)]);
    const std::size_t step = padded(unknowns.size());
    std::vector<float> values(step * idx(front.columns), std::numeric_limits<float>::quiet_NaN());
    assembly.assemble(f, A, scale, {values.data(), unknowns.size(), idx(front.columns)});
    for (std::size_t j = 0; j < idx(front.columns); ++j)
      for (std::size_t i = j; i < step; ++i) {
        float expected = 0.0F;
        if (i < unknowns.size() && coupled(pattern, unknowns[i], unknowns[j]) &&
            (i == j || (constrained[idx(unknowns[i])] == 0 && constrained[idx(unknowns[j])] == 0)))
          expected = static_cast<float>(scale * entry(A, unknowns[i], unknowns[j]));
        ASSERT_EQ(values[j * step + i], expected) << "front " << f << ", " << i << ", " << j;
      }
  }
}

TEST(FrontAssembly, fills_panels_with_columns_of_the_matrix) {
  expect_columns_of_matrix(box_mesh({.kind = ElementKind::quad4, .cells = {9, 7, 1}}), 0);
  expect_columns_of_matrix(box_mesh({.kind = ElementKind::quad8, .cells = {4, 5, 1}}), 0);
  expect_columns_of_matrix(box_mesh({.kind = ElementKind::hex8, .cells = {4, 3, 5}}), 0);
}

TEST(FrontAssembly, fills_them_where_some_unknowns_of_nodes_are_alone) {
  for (const Index every : {2, 3, 7}) { // 2: all x in the plane
    expect_columns_of_matrix(box_mesh({.kind = ElementKind::quad4, .cells = {9, 7, 1}}), every);
    expect_columns_of_matrix(box_mesh({.kind = ElementKind::hex8, .cells = {4, 3, 5}}), every);
  }
}

} // namespace
} // namespace billet::mechanics::front_assembly_test
