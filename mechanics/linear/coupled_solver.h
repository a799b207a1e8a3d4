// Solution of the linear systems of a part whose surface may meet itself.
//
// As long as nothing is coupled outside of the mesh's pattern this is a LinearSolver. Where there
// are couplings the pattern grows by the pairs of nodes that they are between, and a second solver,
// with an order of its own, solves over the grown pattern. It is kept while it has a place for
// every pair of a system; a pair that it has too many costs little, a new order much.

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/sparse_matrix.h"

#include <memory>
#include <span>
#include <vector>

namespace billet::mechanics {

class CoupledSolver {
public:
  /// @pre pattern outlives the solver
  CoupledSolver(const BlockPattern& pattern, SolverSettings settings);

  /// See LinearSolver.
  void set_constrained(std::span<const char> constrained);
  /// Solves (matrix + couplings) x = rhs; `symmetric` promises that the sum is.
  [[nodiscard]] Outcome<SolveReport> solve(const SparseMatrix& matrix,
                                           std::span<const Coupling> couplings,
                                           bool symmetric,
                                           std::span<const double> rhs,
                                           std::span<double> x,
                                           const SolveOptions& options = {});
  /// Solves for another right-hand side, just after `solve` with the same matrix and couplings.
  [[nodiscard]] Outcome<SolveReport> solve_again(const SparseMatrix& matrix,
                                                 bool symmetric,
                                                 std::span<const double> rhs,
                                                 std::span<double> x,
                                                 double tolerance);
  /// See LinearSolver; the grown pattern is forgotten as well.
  void forget();

  [[nodiscard]] SolverWork work() const;

private:
  /// The mesh's pattern with further pairs, and the last system over it.
  struct Grown {
    std::vector<NodePair> pairs; ///< sorted
    BlockPattern pattern;
    std::vector<Index> entries; ///< of the mesh's pattern there
    SparseMatrix matrix{};
    std::unique_ptr<LinearSolver> solver{};
  };
  /// Makes sure that there is a place for all couplings.
  void grow(std::span<const Coupling> couplings);
  /// Sets the sum of both over the grown pattern.
  void add(const SparseMatrix& matrix, std::span<const Coupling> couplings);

  const BlockPattern* pattern_;
  SolverSettings settings_;
  LinearSolver plain_;
  std::vector<char> constrained_; ///< shape (n_dofs) or none
  std::unique_ptr<Grown> grown_;  ///< empty: nothing has been coupled lately
  bool coupled_ = false;          ///< the last system was
  SolverWork gone_;               ///< of grown solvers that are no more
};

} // namespace billet::mechanics
