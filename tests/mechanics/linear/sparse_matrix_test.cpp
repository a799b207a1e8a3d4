#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/tensors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace billet::mechanics::sparse_matrix_test {
namespace {

constexpr std::array kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::hex8,
                           ElementKind::hex20};

Mesh sample(ElementKind kind) { return box_mesh({.kind = kind, .cells = {4, 3, 2}}); }

Eigen::MatrixXd dense(const SparseMatrix& A) {
  const Index n = A.pattern->n_dofs();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = A.pattern->row_start[static_cast<std::size_t>(i)];
         k < A.pattern->row_start[static_cast<std::size_t>(i) + 1]; ++k)
      D(i, A.pattern->columns[static_cast<std::size_t>(k)]) = A.values[static_cast<std::size_t>(k)];
  return D;
}

TEST(BlockPattern, couples_exactly_the_nodes_that_share_an_element) {
  for (const ElementKind kind : kinds) {
    const Mesh mesh = sample(kind);
    const BlockPattern pattern = block_pattern(mesh);
    std::set<std::pair<Index, Index>> coupled;
    for (Index e = 0; e < mesh.n_elements(); ++e)
      for (const Index a : mesh.cell(e))
        for (const Index b : mesh.cell(e))
          coupled.insert({a, b});
    EXPECT_EQ(pattern.n_nodes(), mesh.n_points());
    EXPECT_EQ(pattern.neighbours.size(), coupled.size());
    for (const auto& [a, b] : coupled) {
      const Index at = pattern.neighbour_start[static_cast<std::size_t>(a)] + pattern.offset(a, b);
      ASSERT_EQ(pattern.neighbours[static_cast<std::size_t>(at)], b);
    }
    EXPECT_EQ(pattern.n_entries(),
              coupled.size() * static_cast<std::size_t>(pattern.dim * pattern.dim));
    for (std::size_t i = 0; i + 1 < pattern.row_start.size(); ++i)
      EXPECT_TRUE(std::is_sorted(pattern.columns.begin() + pattern.row_start[i],
                                 pattern.columns.begin() + pattern.row_start[i + 1],
                                 std::less_equal<>()));
  }
}

TEST(BlockPattern, keeps_a_node_that_no_element_uses) {
  Mesh mesh = sample(ElementKind::quad4);
  mesh.points.emplace_back(9, 9, 0);
  const BlockPattern pattern = block_pattern(mesh);
  EXPECT_EQ(pattern.n_nodes(), mesh.n_points());
  EXPECT_EQ(pattern.offset(mesh.n_points() - 1, mesh.n_points() - 1), 0);
}

TEST(BlockPattern, knows_where_its_diagonal_and_the_mirror_of_each_block_are) {
  for (const ElementKind kind : kinds) {
    const BlockPattern pattern = block_pattern(sample(kind));
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      ASSERT_EQ(pattern.diagonal[idx(i)], pattern.entry(i, i));
    for (Index a = 0; a < pattern.n_nodes(); ++a)
      for (Index k = pattern.neighbour_start[idx(a)]; k < pattern.neighbour_start[idx(a) + 1]; ++k)
        ASSERT_EQ(pattern.mirror[idx(k)], pattern.offset(pattern.neighbours[idx(k)], a));
  }
}

TEST(Scatter, pieces_with_a_common_node_wait_for_each_other_and_every_group_is_in_one) {
  for (const ElementKind kind : kinds) {
    const Mesh mesh = sample(kind);
    const BlockPattern pattern = block_pattern(mesh);
    const Scatter scatter(pattern, mesh.cells, nodes_per_element(kind));
    std::vector<Index> all = scatter.order();
    std::sort(all.begin(), all.end());
    ASSERT_EQ(static_cast<Index>(all.size()), mesh.n_elements());
    for (Index e = 0; e < mesh.n_elements(); ++e)
      ASSERT_EQ(all[static_cast<std::size_t>(e)], e);
    const auto& pieces = scatter.piece_start();
    EXPECT_EQ(pieces.back(), mesh.n_elements());
    const std::size_t n = pieces.size() - 1;
    std::vector<std::set<Index>> nodes(n);
    std::vector<std::set<std::size_t>> after(n); // by any way along those that wait
    std::vector<Index> waits(n, 0);
    for (std::size_t p = n; p-- > 0;) {
      for (Index k = pieces[p]; k < pieces[p + 1]; ++k)
        for (const Index a : scatter.nodes(scatter.order()[idx(k)]))
          nodes[p].insert(a);
      for (const Index q : scatter.followers(static_cast<Index>(p))) {
        ASSERT_GT(idx(q), p);
        ++waits[idx(q)];
        after[p].insert(idx(q));
        after[p].insert(after[idx(q)].begin(), after[idx(q)].end());
      }
    }
    EXPECT_EQ(waits, scatter.waits());
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        const bool meet = std::any_of(nodes[p].begin(), nodes[p].end(),
                                      [&](Index a) { return nodes[q].count(a) > 0; });
        EXPECT_TRUE(!meet || after[p].count(q) > 0) << p << " " << q;
      }
  }
}

TEST(Scatter, pieces_keep_together_what_shares_rows) {
  const Mesh mesh =
      box_mesh({ElementKind::hex8, Vec3::Zero(), Vec3(1, 1, 1), {12, 12, 12}, {1, 1, 1}});
  const Scatter scatter(block_pattern(mesh), mesh.cells, 8);
  std::size_t visits = 0; // of a node by a piece
  const auto& pieces = scatter.piece_start();
  for (std::size_t p = 0; p + 1 < pieces.size(); ++p) {
    std::set<Index> nodes;
    for (Index k = pieces[p]; k < pieces[p + 1]; ++k)
      for (const Index a : scatter.nodes(scatter.order()[static_cast<std::size_t>(k)]))
        nodes.insert(a);
    visits += nodes.size();
  }
  EXPECT_LT(visits, 3 * mesh.points.size()) << "8 visits a node where no element keeps to another";
}

// A node shared by more pieces than there are colour bits: a fan of 500 lines from one node.
TEST(Scatter, stays_right_when_there_are_more_colours_than_bits) {
  constexpr Index n = 500;
  std::vector<Index> lines;
  BlockPattern pattern;
  pattern.dim = 1;
  pattern.neighbour_start.push_back(0);
  for (Index a = 0; a <= n; ++a) {
    for (Index b = 0; b <= n; ++b)
      pattern.neighbours.push_back(b);
    pattern.neighbour_start.push_back(static_cast<Index>(pattern.neighbours.size()));
    if (a > 0)
      lines.insert(lines.end(), {0, a});
  }
  const Scatter scatter(pattern, lines, 2);
  EXPECT_GT(scatter.waits().size(), 64U);
  EXPECT_EQ(std::count(scatter.waits().begin(), scatter.waits().end(), 0), 1) << "one begins";
  std::set<Index> groups(scatter.order().begin(), scatter.order().end());
  EXPECT_EQ(static_cast<Index>(groups.size()), n);
}

TEST(Scatter, adds_blocks_and_vectors_where_they_belong) {
  support::Random random(3);
  const Mesh mesh = sample(ElementKind::quad8);
  const BlockPattern pattern = block_pattern(mesh);
  const Scatter scatter(pattern, mesh.cells, 8);
  SparseMatrix A{&pattern, std::vector<double>(pattern.n_entries())};
  std::vector<double> v(static_cast<std::size_t>(pattern.n_dofs()));
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(pattern.n_dofs(), pattern.n_dofs());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(pattern.n_dofs());
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    const std::vector<double> block = random.list(16 * 16, 1.0);
    const std::vector<double> local = random.list(16, 1.0);
    scatter.add(pattern, e, block.data(), A.values);
    scatter.add(2, e, local.data(), v);
    const auto unknown = [&](int i) {
      return mesh.cell(e)[static_cast<std::size_t>(i / 2)] * 2 + i % 2;
    };
    for (int i = 0; i < 16; ++i) {
      w[unknown(i)] += local[static_cast<std::size_t>(i)];
      for (int j = 0; j < 16; ++j)
        D(unknown(i), unknown(j)) +=
            block[static_cast<std::size_t>(i) * 16 + static_cast<std::size_t>(j)];
    }
  }
  EXPECT_EQ(dense(A), D);
  EXPECT_EQ((Eigen::Map<const Eigen::VectorXd>(v.data(), w.size())), w);
}

TEST(SparseMatrix, multiplies_like_the_dense_matrix) {
  support::Random random(4);
  const BlockPattern pattern = block_pattern(sample(ElementKind::hex8));
  const SparseMatrix A{&pattern, random.list(pattern.n_entries(), 1.0)};
  const auto n = static_cast<std::size_t>(pattern.n_dofs());
  const std::vector<double> x = random.list(n, 1.0);
  std::vector<double> y(n);
  A.multiply(x, y);
  const Eigen::VectorXd reference =
      dense(A) * Eigen::Map<const Eigen::VectorXd>(x.data(), pattern.n_dofs());
  constexpr double rounding = 1e-14;
  EXPECT_LE((Eigen::Map<const Eigen::VectorXd>(y.data(), reference.size()) - reference).norm(),
            rounding * reference.norm());
}

TEST(SparseMatrix, asymmetry_is_that_of_the_dense_matrix) {
  support::Random random(5);
  for (const ElementKind kind : kinds) {
    const BlockPattern pattern = block_pattern(sample(kind));
    SparseMatrix A{&pattern, random.list(pattern.n_entries(), 1.0)};
    const Eigen::MatrixXd D = dense(A);
    const double reference = (D - D.transpose()).cwiseAbs().maxCoeff() / D.cwiseAbs().maxCoeff();
    EXPECT_DOUBLE_EQ(A.asymmetry(), reference);
    std::fill(A.values.begin(), A.values.end(), 3.0);
    EXPECT_EQ(A.asymmetry(), 0.0);
    A.values[1] = 3.3; // row 0, column 1
    EXPECT_NEAR(A.asymmetry(), 0.3 / 3.3, 1e-15);
    std::fill(A.values.begin(), A.values.end(), 0.0);
    EXPECT_EQ(A.asymmetry(), 0.0);
  }
}

TEST(SparseMatrix, symmetric_part_is_that_of_the_dense_matrix_without_what_is_not_symmetric) {
  support::Random random(6);
  for (const ElementKind kind : kinds) {
    const BlockPattern pattern = block_pattern(sample(kind));
    SparseMatrix A{&pattern, random.list(pattern.n_entries(), 1.0)};
    Eigen::MatrixXd D = dense(A);
    // Twice the same entry, two that mirror each other, one on the diagonal.
    for (const auto& [row, column] :
         {std::pair<Index, Index>{0, 1}, {0, 1}, {1, 0}, {2, 2}, {3, 0}}) {
      A.unsymmetric.push_back({row, pattern.entry(row, column), 0.25});
      D(row, column) -= 0.25;
    }
    SparseMatrix part;
    A.take_symmetric_part(part);
    const Eigen::MatrixXd reference = 0.5 * (D + D.transpose());
    constexpr double rounding = 1e-15;
    EXPECT_LE((dense(part) - reference).cwiseAbs().maxCoeff(), rounding);
  }
}

} // namespace
} // namespace billet::mechanics::sparse_matrix_test
