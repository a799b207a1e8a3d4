#include "mechanics/linear_solver.h"

#include <metis.h>

#include <algorithm>
#include <cmath>

namespace billet::mechanics {

namespace {

double norm(std::span<const double> v) {
  double sum = 0.0;
  for (const double x : v)
    sum += x * x;
  return std::sqrt(sum);
}

/// Solves that cost as much as a factorization; 0 where the difference is not worth a correction
/// that is less than exact. Counted, not timed, so that a run repeats. The constants are measured:
/// a factorization runs at the speed of matrix products plus some work for every entry, a solve at
/// that of memory.
int most_solves(const FactorCost& cost) {
  constexpr double per_entry = 5.0;
  constexpr double flops_per_entry = 50.0;
  constexpr double fewest = 8.0;
  constexpr double most = 40.0; // the directions are all kept
  const double intensity = cost.entries > 0.0 ? cost.flops / cost.entries : 0.0;
  const double solves = std::min(per_entry + intensity / flops_per_entry, most);
  return solves < fewest ? 0 : static_cast<int>(solves);
}

} // namespace

std::vector<Index> fill_reducing_order(const BlockPattern& pattern) {
  const Index n = pattern.n_nodes();
  std::vector<idx_t> start{0};
  std::vector<idx_t> graph;
  for (Index a = 0; a < n; ++a) {
    const auto i = static_cast<std::size_t>(a);
    for (Index k = pattern.neighbour_start[i]; k < pattern.neighbour_start[i + 1]; ++k)
      if (pattern.neighbours[static_cast<std::size_t>(k)] != a)
        graph.push_back(pattern.neighbours[static_cast<std::size_t>(k)]);
    start.push_back(static_cast<idx_t>(graph.size()));
  }
  std::vector<idx_t> permutation(static_cast<std::size_t>(n));
  std::vector<idx_t> inverse(static_cast<std::size_t>(n));
  idx_t vertices = n;
  if (n > 1)
    METIS_NodeND(&vertices, start.data(), graph.data(), nullptr, nullptr, permutation.data(),
                 inverse.data());
  std::vector<Index> order;
  for (const idx_t node : permutation)
    for (int i = 0; i < pattern.dim; ++i)
      order.push_back(static_cast<Index>(node) * pattern.dim + i);
  return order;
}

LinearSolver::LinearSolver(const BlockPattern& pattern, SolverChoice choice)
    : pattern_(&pattern), choice_(choice), order_(fill_reducing_order(pattern)),
      residual_(static_cast<std::size_t>(pattern.n_dofs())) {}

Outcome<SolveReport> LinearSolver::solve_with(Factorization& factorization,
                                              std::string_view method,
                                              const SparseMatrix& matrix,
                                              std::span<const double> rhs,
                                              std::span<double> x) {
  last_ = nullptr;
  if (!factorization.factorize(matrix))
    return Failure{"the tangent is singular (" + std::string(method) + ")"};
  auto report = back_substitute(factorization, method, matrix, rhs, x);
  if (report) {
    last_ = &factorization;
    current_ = true;
  }
  return report;
}

Outcome<SolveReport> LinearSolver::back_substitute(Factorization& factorization,
                                                   std::string_view method,
                                                   const SparseMatrix& matrix,
                                                   std::span<const double> rhs,
                                                   std::span<double> x) {
  std::copy(rhs.begin(), rhs.end(), x.begin());
  factorization.solve(x);
  // Backward stable factorizations leave 1e-14 or so; one refinement mends a poor pivot order.
  constexpr double wanted = 1e-10;
  const double scale = norm(rhs);
  SolveReport report{method, 0.0};
  for (int pass = 0; pass < 2; ++pass) {
    matrix.multiply(x, residual_);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      residual_[i] = rhs[i] - residual_[i];
    report.relative_residual = scale > 0.0 ? norm(residual_) / scale : 0.0;
    if (report.relative_residual <= wanted || pass == 1)
      break;
    factorization.solve(residual_);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      x[i] += residual_[i];
  }
  if (!std::isfinite(report.relative_residual) || report.relative_residual > 1e-3)
    return Failure{"the linear system has no accurate solution (" + std::string(method) + ")"};
  return report;
}

Outcome<SolveReport> LinearSolver::solve(const SparseMatrix& matrix,
                                         bool symmetric,
                                         std::span<const double> rhs,
                                         std::span<double> x,
                                         double tolerance) {
  current_ = false;
  const bool may_reuse = tolerance > 0.0 && choice_ == SolverChoice::automatic;
  const int most = may_reuse && last_ != nullptr ? most_solves(last_->cost()) : 0;
  if (most > 0) {
    const GmresReport report = gmres_.solve(matrix, *last_, rhs, x, tolerance, most);
    if (report.converged)
      return SolveReport{"gmres", report.residual};
  }
  return factorize_and_solve(matrix, symmetric, rhs, x);
}

Outcome<SolveReport> LinearSolver::solve_again(const SparseMatrix& matrix,
                                               bool symmetric,
                                               std::span<const double> rhs,
                                               std::span<double> x,
                                               double tolerance) {
  if (current_)
    return back_substitute(*last_, "again", matrix, rhs, x);
  return solve(matrix, symmetric, rhs, x, tolerance);
}

Outcome<SolveReport> LinearSolver::factorize_and_solve(const SparseMatrix& matrix,
                                                       bool symmetric,
                                                       std::span<const double> rhs,
                                                       std::span<double> x) {
  const bool fast = choice_ == SolverChoice::automatic || choice_ == SolverChoice::cholmod;
  if (symmetric && fast) {
    if (!cholmod_)
      cholmod_ = make_cholmod(*pattern_, order_);
    auto outcome = solve_with(*cholmod_, "cholmod", matrix, rhs, x);
    if (outcome)
      return outcome;
  }
  if (choice_ != SolverChoice::umfpack) {
    auto& mumps = symmetric ? mumps_symmetric_ : mumps_;
    if (!mumps)
      mumps = make_mumps(*pattern_, order_, symmetric);
    auto outcome = solve_with(*mumps, symmetric ? "mumps-ldlt" : "mumps-lu", matrix, rhs, x);
    if (outcome || choice_ == SolverChoice::mumps)
      return outcome;
  }
  if (!umfpack_)
    umfpack_ = make_umfpack(*pattern_, order_);
  return solve_with(*umfpack_, "umfpack", matrix, rhs, x);
}

} // namespace billet::mechanics
