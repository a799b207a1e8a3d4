#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multifrontal/branches.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace billet::mechanics::branches_test {
namespace {

struct Block {
  BlockPattern pattern;
  std::shared_ptr<const Elimination> elimination;
  explicit Block(int cells)
      : pattern(block_pattern(
            box_mesh({.kind = ElementKind::hex8, .cells = {cells, cells, cells + 1}}))),
        elimination(std::make_shared<const Elimination>(pattern, fill_reducing_order(pattern))) {}
};

TEST(Branches, hold_every_front_once_and_know_nothing_of_each_other_within_a_level) {
  const Block block(9);
  const auto fronts = block.elimination->fronts();
  for (const double of_flops : {0.3, 1.0 / 16, 1.0 / 64, 1e-3}) {
    const Branches branches(*block.elimination, of_flops, 0.0);
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> branch_of(fronts.size(), none);
    std::vector<std::size_t> level_of(fronts.size(), none);
    for (std::size_t level = 0; level < branches.levels(); ++level)
      for (std::size_t b = branches.begin(level); b < branches.begin(level + 1); ++b)
        for (std::size_t f = branches.all()[b].begin; f < branches.all()[b].end; ++f) {
          EXPECT_EQ(branch_of[f], none);
          branch_of[f] = b;
          level_of[f] = level;
        }
    EXPECT_GT(branches.levels(), 1U);
    for (std::size_t f = 0; f < fronts.size(); ++f) {
      ASSERT_NE(branch_of[f], none) << f;
      if (fronts[f].parent < 0)
        continue;
      const auto parent = static_cast<std::size_t>(fronts[f].parent);
      const bool same = branch_of[f] == branch_of[parent];
      EXPECT_TRUE(same || level_of[f] < level_of[parent]) << f;
      EXPECT_EQ(branches.is_handed_up(f), !same) << f;
    }
  }
}

TEST(Branches, are_one_where_there_is_little_to_do) {
  const Block block(3);
  const Branches branches(*block.elimination);
  ASSERT_EQ(branches.all().size(), 1U);
  EXPECT_EQ(branches.levels(), 1U);
  EXPECT_EQ(branches.all()[0].end, block.elimination->fronts().size());
}

/// A stiff matrix over a pattern: springs between neighbours.
SparseMatrix springs(const BlockPattern& pattern) {
  SparseMatrix matrix{&pattern, std::vector<double>(pattern.n_entries(), 0.0)};
  for (Index i = 0; i < pattern.n_dofs(); ++i)
    for (Index k = pattern.row_start[idx(i)]; k < pattern.row_start[idx(i) + 1]; ++k) {
      const Index j = pattern.columns[idx(k)];
      if (i == j)
        matrix.values[idx(k)] += 1e-3;
      else if (i % 3 == j % 3) {
        const double stiffness = 1.0 + std::abs(std::sin(double(i) * double(j)));
        matrix.values[idx(k)] = -stiffness;
        matrix.values[idx(pattern.diagonal[idx(i)])] += stiffness;
      }
    }
  return matrix;
}

TEST(Branches, lead_to_the_same_bits_with_any_number_of_threads) {
  const Block block(17); // its largest front is shared in substitutions as well
  const SparseMatrix matrix = springs(block.pattern);
  const auto n = static_cast<std::size_t>(block.pattern.n_dofs());
  std::vector<double> rhs(n);
  for (std::size_t i = 0; i < n; ++i)
    rhs[i] = std::cos(static_cast<double>(i));
  std::vector<double> first;
  for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    const auto factorization = make_single(block.elimination);
    for (int again = 0; again < 3; ++again) {
      ASSERT_TRUE(factorization->factorize(matrix));
      std::vector<double> x = rhs;
      factorization->solve(x);
      if (first.empty())
        first = x;
      ASSERT_TRUE(x == first) << threads << " threads";
    }
    std::vector<double> left(n);
    matrix.multiply(first, left);
    double missing = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      missing = std::max(missing, std::abs(left[i] - rhs[i]));
    EXPECT_LE(missing, 2e-4);
    factorization->release();
  }
}

TEST(Branches, a_lost_pivot_is_told_whoever_meets_it) {
  const Block block(9);
  for (const Index unknown : {Index{0}, block.pattern.n_dofs() / 2, block.pattern.n_dofs() - 1}) {
    SparseMatrix matrix = springs(block.pattern);
    const auto factorization = make_single(block.elimination);
    ASSERT_TRUE(factorization->factorize(matrix));
    const std::vector<double> good = matrix.values;
    for (Index k = block.pattern.row_start[idx(unknown)];
         k < block.pattern.row_start[idx(unknown) + 1]; ++k) {
      matrix.values[idx(k)] = 0.0;
      matrix.values[idx(block.pattern.entry(block.pattern.columns[idx(k)], unknown))] = 0.0;
    }
    EXPECT_FALSE(factorization->factorize(matrix)) << unknown;
    matrix.values = good;
    EXPECT_TRUE(factorization->factorize(matrix)) << "and nothing of it is left";
  }
}

} // namespace
} // namespace billet::mechanics::branches_test
