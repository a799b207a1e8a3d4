// Multigrid on the tangent of a block, where its component is there.

#include "mechanics/bulk/bulk.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multigrid/multigrid.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace billet::mechanics::multigrid_test {
namespace {

/// A block of elastic metal that stands on its lower face: tangent and a load.
struct Block {
  Mesh mesh;
  BlockPattern pattern;
  System system;
  std::vector<double> rhs;

  Block(ElementKind kind, int cells)
      : mesh(box_mesh({kind, Vec3::Zero(), Vec3(2.0, 1.0, 1.0), {2 * cells, cells, cells}})),
        pattern(block_pattern(mesh)) {
    const std::vector<double> x = node_positions(mesh);
    system.tangent.pattern = &pattern;
    system.tangent.values.resize(pattern.n_entries());
    system.residual.resize(x.size());
    Bulk bulk(mesh, Analysis::solid, Material{{210e3, 0.3}, Perfect{1e9}}, pattern);
    EXPECT_TRUE(bulk.assemble({0.0, 1.0, x, x}, system));
    rhs.assign(x.size(), 0.0);
    for (std::size_t a = 0; a < mesh.points.size(); ++a)
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t i = 3 * a + d;
        if (mesh.points[a].z() == 0.0)
          hold(i);
        else
          rhs[i] = std::sin(static_cast<double>(i));
      }
  }
  /// As Newton's method prescribes an unknown.
  void hold(std::size_t i) {
    for (Index k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k) {
      const Index j = pattern.columns[idx(k)];
      if (idx(j) == i)
        continue;
      system.tangent.values[idx(k)] = 0.0;
      system.tangent.values[idx(pattern.entry(j, static_cast<Index>(i)))] = 0.0;
    }
  }
  [[nodiscard]] double missing(const std::vector<double>& x) const {
    std::vector<double> product(x.size());
    system.tangent.multiply(x, product);
    double squares = 0.0, all = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      squares += (product[i] - rhs[i]) * (product[i] - rhs[i]);
      all += rhs[i] * rhs[i];
    }
    return std::sqrt(squares / all);
  }
};

TEST(Multigrid, solves_what_a_factorization_solves_with_iterations_that_do_not_grow) {
  if (!Multigrid::is_there())
    GTEST_SKIP() << "built without BILLET_MULTIGRID";
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    long coarse = 0;
    for (const int cells : {3, 6}) {
      const Block block(kind, cells);
      LinearSolver solver(block.pattern, {SolverChoice::multigrid});
      std::vector<double> x(block.rhs.size());
      SolveOptions options{1e-8};
      const std::vector<double> positions = node_positions(block.mesh);
      options.positions = positions;
      const auto solved = solver.solve(block.system.tangent, true, block.rhs, x, options);
      ASSERT_TRUE(solved) << solved.error().reason;
      EXPECT_EQ(solved->method, "multigrid");
      EXPECT_LE(block.missing(x), 1e-7);
      EXPECT_EQ(solver.work().multigrid, 1);
      const long cycles = solver.work().substitutions;
      std::printf("%d cells of kind %d: %ld cycles\n", cells, static_cast<int>(kind), cycles);
      if (coarse > 0) {
        EXPECT_LE(static_cast<double>(cycles), 1.6 * static_cast<double>(coarse));
      }
      coarse = cycles;
      // The same matrix again: no set-up of its own.
      options.tolerance = 1e-4;
      ASSERT_TRUE(solver.solve(block.system.tangent, true, block.rhs, x, options));
      EXPECT_EQ(solver.work().reused, 1);
    }
  }
}

// Indefinite: every second unknown has a stiffness of the wrong sign.
TEST(Multigrid, leaves_to_a_factorization_what_it_does_not_solve) {
  if (!Multigrid::is_there())
    GTEST_SKIP() << "built without BILLET_MULTIGRID";
  Block block(ElementKind::hex8, 6);
  for (std::size_t i = 0; i < block.rhs.size(); i += 2)
    block.system.tangent.values[idx(block.pattern.diagonal[i])] *= -1.0;
  LinearSolver solver(block.pattern, {SolverChoice::multigrid});
  std::vector<double> x(block.rhs.size());
  const std::vector<double> positions = node_positions(block.mesh);
  SolveOptions options{1e-8};
  options.positions = positions;
  const auto solved = solver.solve(block.system.tangent, true, block.rhs, x, options);
  ASSERT_TRUE(solved) << solved.error().reason;
  EXPECT_NE(solved->method, "multigrid");
  EXPECT_EQ(solver.work().multigrid_failed, 1);
  EXPECT_LE(block.missing(x), 1e-6);
}

} // namespace
} // namespace billet::mechanics::multigrid_test
