// Systems that a component around PETSc solves: multigrid in one process, or all that several
// processes share.

#include "geometry/base/memory.h"
#include "mechanics/linear/distributed/distributed_solver.h"
#include "mechanics/linear/exact_residual.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/linear/multigrid/multigrid.h"
#include "mechanics/linear/solver_estimate.h"

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <utility>

namespace billet::mechanics {

bool LinearSolver::takes_multigrid() {
  if (settings_.choice == SolverChoice::multigrid)
    return true;
  if (settings_.choice != SolverChoice::automatic)
    return false;
  const auto is_cheaper = [this] {
    SystemSize size{pattern_->dim, static_cast<double>(pattern_->n_entries())};
    if (!may_pay(size))
      return false;
    try {
      size.factor_entries = elimination()->entries();
      size.operations = elimination()->flops();
    } catch (const std::bad_alloc&) {
      return true; // the factors have more entries than can be counted
    }
    const double all = std::numeric_limits<double>::infinity();
    return prefers_multigrid(size, available_memory().value_or(all));
  };
  if (!takes_multigrid_) {
    takes_multigrid_ = is_cheaper() && Multigrid::is_there();
    if (*takes_multigrid_)
      elimination_.reset(); // it may never be needed
  }
  return *takes_multigrid_;
}

DistributedSolver* LinearSolver::distributed() const {
  return dynamic_cast<DistributedSolver*>(component_.get());
}

Outcome<Factorization*> LinearSolver::prepared_multigrid() {
  if (DistributedSolver* all_processes = distributed()) {
    all_processes->choose(distributed_multigrid);
  } else if (!component_) {
    auto made = Multigrid::make();
    if (!made)
      return made.error();
    component_ = std::move(*made);
  }
  return component_.get();
}

Outcome<SolveReport> LinearSolver::solve_by_multigrid(const SparseMatrix& matrix,
                                                      std::span<const double> rhs,
                                                      std::span<double> x,
                                                      const SolveOptions& options) {
  const Outcome<Factorization*> multigrid = prepared_multigrid();
  if (!multigrid)
    return multigrid.error();
  correction_ = 0.0;
  (*multigrid)->set_positions(options.positions);
  if (!factorize(**multigrid, "multigrid", matrix))
    return Failure{"multigrid cannot be set up"};
  constexpr Patience patience{300}; // the first do little where contact is stiff
  const double enough = std::max(options.tolerance, exact);
  const GmresReport report = iterate(matrix, rhs, x, enough, patience, {});
  if (!report.converged) {
    last_ = nullptr;
    return Failure{"no convergence (multigrid)"};
  }
  factor_of_ = FactorOf::symmetrized;
  return SolveReport{"multigrid", report.residual};
}

Outcome<SolveReport> LinearSolver::solve_distributed(const SparseMatrix& matrix,
                                                     bool symmetric,
                                                     std::span<const double> rhs,
                                                     std::span<double> x,
                                                     const SolveOptions& options) {
  const auto attempt = [&](DistributedMethod method, std::string_view name,
                           const SparseMatrix& factorized) -> Outcome<SolveReport> {
    correction_ = 0.0;
    distributed()->choose(method);
    if (!factorize(*component_, name, factorized))
      return Failure{"the tangent is singular (" + std::string(name) + ")"};
    return solve_with_neighbour(name, matrix, rhs, x, options, {});
  };
  if (settings_.choice == SolverChoice::superlu_dist)
    return attempt(distributed_superlu, "superlu-dist", matrix);
  if (symmetric)
    return attempt(distributed_ldlt, "mumps-ldlt", matrix);
  if (backoff_.symmetric.due()) {
    matrix.take_symmetric_part(symmetric_part_);
    auto outcome = attempt(distributed_ldlt, "mumps-ldlt-gmres", symmetric_part_);
    if (outcome)
      ++work_.nearly_symmetric;
    free_memory(symmetric_part_.values);
    backoff_.symmetric.take(bool(outcome));
    if (outcome)
      return outcome;
  }
  return attempt(distributed_lu, "mumps-lu", matrix);
}

} // namespace billet::mechanics
