#include "mechanics/linear/distributed/distributed_solver.h"

#include "mechanics/linear/distributed/processes.h"
#include "mechanics/linear/solver_estimate.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace billet::mechanics {

namespace {

/// @return whether it was done; that a matrix is singular, say, is no error
bool checked(int status) {
  if (status == distributed_no_memory)
    throw std::bad_alloc();
  return status == distributed_done;
}

} // namespace

bool DistributedSolver::serves(const BlockPattern& pattern, SolverChoice choice) {
  if (number_of_processes() == 1)
    return false;
  if (choice == SolverChoice::automatic)
    return may_pay({pattern.dim, static_cast<double>(pattern.n_entries())});
  return choice == SolverChoice::multigrid || choice == SolverChoice::mumps ||
         choice == SolverChoice::superlu_dist;
}

DistributedSolver::DistributedSolver(const BlockPattern& pattern)
    : pattern_(&pattern), component_(&distributed_component()) {}

DistributedSolver::~DistributedSolver() {
  if (system_ >= 0)
    component_->destroy(system_);
}

void DistributedSolver::send(const SparseMatrix& matrix) {
  if (system_ < 0) {
    parts_ = node_parts(*pattern_, number_of_processes());
    const DistributedPattern pattern{
        pattern_->dim,
        pattern_->n_nodes(),
        pattern_->neighbour_start.data(),
        pattern_->neighbours.data(),
        parts_.order.data(),
        parts_.start.data(),
    };
    system_ = component_->make(&pattern);
    if (system_ < 0)
      throw std::runtime_error(std::string("no distributed matrix: ") + component_->reason());
  }
  if (sent_ == &matrix)
    return;
  if (!checked(component_->set_values(system_, matrix.values.data())))
    throw std::runtime_error(std::string("no distributed values: ") + component_->reason());
  sent_ = &matrix;
}

bool DistributedSolver::factorize(const SparseMatrix& matrix) {
  send(matrix);
  DistributedSetUp set_up{method_, positions_.data(), 0.0, 0.0};
  if (!checked(component_->set_up(system_, &set_up)))
    return false;
  constexpr double cycles = 40.0, products = 8.0, per_entry = 2.0; // of multigrid, as in Multigrid
  const bool counted = set_up.flops > 0.0;
  cost_ = {counted ? set_up.flops : cycles * products * per_entry * set_up.entries, set_up.entries,
           sizeof(double)};
  return true;
}

GmresReport DistributedSolver::solve_sent(std::span<const double> weights,
                                          std::span<const double> rhs,
                                          std::span<double> x,
                                          double tolerance,
                                          int most) const {
  DistributedSolve request{
      weights.data(), rhs.data(), x.data(), tolerance, most, 0, 1.0, 0,
  };
  static_cast<void>(checked(component_->solve(system_, &request)));
  return {request.converged != 0, request.iterations, request.iterations, request.residual};
}

GmresReport DistributedSolver::iterate(Gmres&,
                                       const SparseMatrix& matrix,
                                       std::span<const double> weights,
                                       std::span<const double> rhs,
                                       std::span<double> x,
                                       double tolerance,
                                       const Patience& patience,
                                       std::span<const std::vector<double>>) {
  send(matrix);
  return solve_sent(weights, rhs, x, tolerance, patience.most);
}

void DistributedSolver::solve(std::span<double> rhs) {
  constexpr double tolerance = 1e-12;
  constexpr int most = 100;
  const std::vector<double> weights(rhs.size(), 1.0);
  const std::vector<double> right(rhs.begin(), rhs.end());
  if (!solve_sent(weights, right, rhs, tolerance, most).converged)
    std::fill(rhs.begin(), rhs.end(), 0.0); // whoever checks a residual sees it
}

void DistributedSolver::release() {
  if (system_ >= 0)
    component_->release(system_);
}

} // namespace billet::mechanics
