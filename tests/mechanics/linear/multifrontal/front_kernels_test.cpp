#include "mechanics/linear/multifrontal/front_kernels.h"
#include "mechanics/linear/multifrontal/packed_panel.h"
#include "tests/support/figures.h"
#include "tests/support/tensors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace billet::mechanics::front_kernels_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A symmetric matrix, its first columns in a panel.
struct Problem {
  /// @param indefinite  every third pivot negative
  Problem(std::size_t n_rows, std::size_t n_columns, bool indefinite)
      : rows(n_rows), columns(n_columns) {
    support::Random random{static_cast<unsigned>(1000 * rows + columns)};
    const auto n = static_cast<Eigen::Index>(rows);
    const MatrixXd part = Eigen::Map<MatrixXd>(random.list(rows * rows, 1.0).data(), n, n);
    dense = part + part.transpose();
    for (Eigen::Index i = 0; i < n; ++i)
      dense(i, i) = (indefinite && i % 3 == 1 ? -4.0 : 4.0) * std::sqrt(static_cast<double>(n));
    values.assign(padded(rows) * columns + front_lanes, 0.0F);
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t i = 0; i < rows; ++i) // nothing above the diagonal is looked at
        values[j * padded(rows) + i] = i < j ? 1e6F : static_cast<float>(entry(i, j));
    least.assign(columns, 1e-5F);
    inverses.resize(columns);
    signs.resize(columns);
  }

  [[nodiscard]] double entry(std::size_t i, std::size_t j) const {
    return dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] Panel panel() { return {values.data(), rows, columns}; }
  /// The block of the eliminated unknowns, that below it, that behind both.
  [[nodiscard]] MatrixXd block(bool lower, bool right) const {
    const auto n = static_cast<Eigen::Index>(rows), k = static_cast<Eigen::Index>(columns);
    return dense.block(lower ? k : 0, right ? k : 0, lower ? n - k : k, right ? n - k : k);
  }

  std::size_t rows, columns;
  MatrixXd dense;
  std::vector<float> values, least, inverses, signs;
  FrontWork work;
};

/// Below, at and above the sizes at which the products change their way.
constexpr std::array<std::pair<std::size_t, std::size_t>, 16> sizes{{{1, 1},
                                                                     {2, 1},
                                                                     {7, 3},
                                                                     {8, 8},
                                                                     {9, 8},
                                                                     {17, 5},
                                                                     {30, 13},
                                                                     {64, 64},
                                                                     {100, 9},
                                                                     {131, 33},
                                                                     {150, 70},
                                                                     {203, 131},
                                                                     {257, 40},
                                                                     {300, 300},
                                                                     {520, 60},
                                                                     {700, 450}}};

TEST(FrontKernels, leave_the_complement_that_a_dense_elimination_leaves) {
  for (const auto& [rows, columns] : sizes)
    for (const bool indefinite : {false, true}) {
      Problem problem(rows, columns, indefinite);
      ASSERT_TRUE(eliminate(problem.panel(), problem.least.data(), problem.inverses.data(),
                            problem.signs.data(), problem.work));
      const std::size_t rest = rows - columns;
      if (rest == 0)
        continue;
      std::vector<float> complement(padded(rest) * rest,
                                    std::numeric_limits<float>::quiet_NaN()); // is overwritten
      form_complement(problem.panel(), problem.signs.data(), complement.data(), problem.work);
      const MatrixXd reference =
          -problem.block(true, false) *
          problem.block(false, false).partialPivLu().solve(problem.block(false, true));
      double error = 0.0;
      for (std::size_t j = 0; j < rest; ++j)
        for (std::size_t i = j; i < rest; ++i)
          error = std::max(error, std::abs(complement[j * padded(rest) + i] -
                                           reference(static_cast<Eigen::Index>(i),
                                                     static_cast<Eigen::Index>(j))));
      constexpr double digits = 2e-5;
      EXPECT_LE(error, digits * std::sqrt(static_cast<double>(rows)))
          << rows << " " << columns << " " << indefinite;
    }
}

void expect_dense_substitution(Threads threads) {
  for (const auto& [rows, columns] : sizes)
    for (const bool indefinite : {false, true}) {
      Problem problem(rows, columns, indefinite);
      ASSERT_TRUE(eliminate(problem.panel(), problem.least.data(), problem.inverses.data(),
                            problem.signs.data(), problem.work));
      const auto n = static_cast<Eigen::Index>(rows), k = static_cast<Eigen::Index>(columns);
      const VectorXd b = VectorXd::LinSpaced(n, -1.0, 2.0);
      std::vector<float> x(padded(rows), 0.0F);
      for (std::size_t i = 0; i < rows; ++i)
        x[i] = static_cast<float>(b[static_cast<Eigen::Index>(i)]);
      std::vector<DiagonalInverse> diagonal(diagonal_triangles(columns));
      std::vector<float> numbers(packed_size(rows, columns));
      const PackedPanel packed{rows, columns, diagonal.data(), numbers.data()};
      pack(problem.panel(), problem.inverses.data(), packed, threads);
      substitute_forward(packed, x.data(), threads);
      // What is left below: b2 - A21 A11^-1 b1.
      const auto solve = [&](const VectorXd& of) -> VectorXd {
        return problem.block(false, false).partialPivLu().solve(of);
      };
      const VectorXd below =
          n == k ? VectorXd()
                 : VectorXd(b.tail(n - k) - problem.block(true, false) * solve(b.head(k)));
      constexpr double digits = 1e-5;
      for (Eigen::Index i = k; i < n; ++i)
        ASSERT_NEAR(x[static_cast<std::size_t>(i)], below[i - k], digits) << rows << " " << columns;
      // With the rest known: x1 = A11^-1 (b1 - A12 x2).
      const VectorXd known = n == k ? VectorXd() : VectorXd::LinSpaced(n - k, 1.0, -0.5);
      for (Eigen::Index i = 0; i < k; ++i)
        x[static_cast<std::size_t>(i)] *= problem.signs[static_cast<std::size_t>(i)];
      for (Eigen::Index i = k; i < n; ++i)
        x[static_cast<std::size_t>(i)] = static_cast<float>(known[i - k]);
      substitute_backward(packed, x.data(), threads);
      const VectorXd reference =
          solve(n == k ? VectorXd(b) : VectorXd(b.head(k) - problem.block(false, true) * known));
      for (Eigen::Index i = 0; i < k; ++i)
        ASSERT_NEAR(x[static_cast<std::size_t>(i)], reference[i], digits) << rows << " " << columns;
    }
}

TEST(FrontKernels, substitute_as_the_dense_matrix_does) {
  expect_dense_substitution(Threads::one);
  expect_dense_substitution(Threads::all);
}

// By other loops, in which the compiler fuses other multiplications and additions.
TEST(FrontKernels, leave_the_same_whether_threads_share_them) {
  constexpr float digits = 2e-6F;
  FrontTeam team;
  for (const auto& [rows, columns] : sizes) {
    Problem alone(rows, columns, true), shared(rows, columns, true);
    const std::size_t rest = rows - columns;
    std::vector<float> complement(padded(rest) * rest), other(complement.size());
    ASSERT_TRUE(eliminate(alone.panel(), alone.least.data(), alone.inverses.data(),
                          alone.signs.data(), alone.work));
    form_complement(alone.panel(), alone.signs.data(), complement.data(), alone.work);
    ASSERT_TRUE(eliminate(shared.panel(), shared.least.data(), shared.inverses.data(),
                          shared.signs.data(), shared.work, &team));
    form_complement(shared.panel(), shared.signs.data(), other.data(), shared.work, &team);
    EXPECT_EQ(alone.signs, shared.signs);
    for (std::size_t j = 0; j < columns; ++j) {
      ASSERT_NEAR(alone.inverses[j], shared.inverses[j], digits);
      for (std::size_t i = j; i < rows; ++i)
        ASSERT_NEAR(alone.values[j * padded(rows) + i], shared.values[j * padded(rows) + i],
                    digits);
    }
    const float largest = std::sqrt(static_cast<float>(rows));
    for (std::size_t j = 0; j < rest; ++j)
      for (std::size_t i = j; i < rest; ++i)
        ASSERT_NEAR(complement[j * padded(rest) + i], other[j * padded(rest) + i],
                    digits * largest);
  }
}

TEST(PackedPanel, holds_the_rows_below_each_eight_columns) {
  EXPECT_EQ(packed_size(8, 8), 0U);
  EXPECT_EQ(packed_size(9, 8), 64U);            // one block
  EXPECT_EQ(packed_size(17, 5), 5U * 16);       // two of five columns
  EXPECT_EQ(packed_size(24, 11), 128U + 3 * 8); // two of eight columns, one of three
  EXPECT_EQ(diagonal_triangles(8), 1U);
  EXPECT_EQ(diagonal_triangles(9), 2U);
}

TEST(FrontKernels, say_that_a_pivot_is_lost) {
  for (const std::size_t at : {0UL, 5UL, 20UL, 69UL}) {
    Problem problem(150, 70, false);
    for (std::size_t j = 0; j < 70; ++j)
      for (std::size_t i = j; i < 150; ++i)
        if (i == at || j == at)
          problem.values[j * padded(150) + i] = 0.0F;
    EXPECT_FALSE(eliminate(problem.panel(), problem.least.data(), problem.inverses.data(),
                           problem.signs.data(), problem.work))
        << at;
    Problem broken(150, 70, false);
    broken.values[at * padded(150) + at] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(eliminate(broken.panel(), broken.least.data(), broken.inverses.data(),
                           broken.signs.data(), broken.work))
        << at;
  }
}

} // namespace
} // namespace billet::mechanics::front_kernels_test
