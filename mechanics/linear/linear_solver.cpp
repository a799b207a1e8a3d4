#include "mechanics/linear/linear_solver.h"

#include "geometry/base/memory.h"
#include "geometry/base/pieces.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/linear/blas.h"
#include "mechanics/linear/distributed/distributed_solver.h"
#include "mechanics/linear/exact_residual.h"
#include "mechanics/linear/multigrid/multigrid.h"
#include "mechanics/linear/node_graph.h"
#include "mechanics/linear/solver_estimate.h"

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <new>

namespace billet::mechanics {

namespace {

double norm(std::span<const double> v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).norm();
}

/// Solves that cost as much as a factorization; 0 where the difference is not worth a correction
/// that is less than exact. Counted, not timed, so that a run repeats. The constants are measured:
/// a factorization runs at the speed of matrix products plus some work for every entry, a solve at
/// that of memory.
int max_solves(const FactorCost& cost) {
  constexpr double per_entry = 5.0;
  constexpr double flops_per_entry = 50.0;
  constexpr double fewest = 8.0;
  constexpr double most = 40.0; // the directions are all kept
  const double intensity = cost.entries > 0.0 ? cost.flops / cost.entries : 0.0;
  const double solves = std::min(per_entry + intensity / flops_per_entry, most);
  return solves < fewest ? 0 : static_cast<int>(solves);
}

/// Of a number in double precision.
constexpr int fraction_bits = 52;
constexpr int exponent_bias = 1023;

/// How a system is solved that needs no factorization of its own.
constexpr std::string_view with_earlier = "gmres";

/// With a neighbour of the matrix. Every point that slips makes a direction in which the two
/// differ; once these are known the residual falls fast. More iterations cost more than an LU does.
constexpr Patience with_neighbour{48, 24, 3.0};

/// Relative corrections of a solution in single precision: each iteration lessens what is wrong in
/// it by that factor. Beyond a fair one many are asked for. (N.11)
constexpr double good_correction = 1e-4;
constexpr double fair_correction = 1e-3;
constexpr double largest_correction = 0.03;

/// Of a positive number that has all its digits, as std::ilogb, but of many at a time.
int exponent(double number) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(number) >> fraction_bits & 0x7ff) -
         exponent_bias;
}

/// @pre |power| < exponent_bias
double power_of_two(int power) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(power + exponent_bias) << fraction_bits);
}

/// Relative residual that will do with a factorization of the matrix or of a neighbour. In a small
/// problem a few iterations are all that a correction less than exact can save.
///
/// @param correction  of the factorization's first solution
double tolerance_for(double asked, double correction, bool small) {
  constexpr double loosest_if_small = 1e-6;
  if (correction > (small ? good_correction : fair_correction))
    return exact;
  return std::clamp(asked, exact, small ? loosest_if_small : 1.0);
}

} // namespace

GmresReport Factorization::iterate(Gmres& gmres,
                                   const SparseMatrix& matrix,
                                   std::span<const double> weights,
                                   std::span<const double> rhs,
                                   std::span<double> x,
                                   double tolerance,
                                   const Patience& patience,
                                   std::span<const std::vector<double>> known) {
  return gmres.solve(matrix, *this, weights, rhs, x, tolerance, patience, known);
}

SolverWork SolverWork::after(const SolverWork& earlier) const {
  SolverWork sum = *this;
  sum.analysis += earlier.analysis;
  sum.factorization += earlier.factorization;
  sum.substitution += earlier.substitution;
  sum.flops += earlier.flops;
  sum.factorizations += earlier.factorizations;
  sum.substitutions += earlier.substitutions;
  sum.reused += earlier.reused;
  sum.nearly_symmetric += earlier.nearly_symmetric;
  sum.multigrid += earlier.multigrid;
  sum.multigrid_failed += earlier.multigrid_failed;
  sum.systems += earlier.systems;
  return sum;
}

void RetryBackoff::take(bool served) {
  constexpr int max_failures = 5;
  failures_ = served ? 0 : std::min(failures_ + 1, max_failures);
  wait_ = served ? 0 : (1 << failures_) - 2;
}

std::vector<Index> fill_reducing_order(const BlockPattern& pattern) {
  std::vector<Index> order;
  for (const Index node : nested_dissection(node_graph(pattern)))
    for (int i = 0; i < pattern.dim; ++i)
      order.push_back(node * pattern.dim + i);
  return order;
}

LinearSolver::LinearSolver(const BlockPattern& pattern, SolverSettings settings)
    : pattern_(&pattern), settings_(settings),
      residual_(static_cast<std::size_t>(pattern.n_dofs())) {
  if (DistributedSolver::serves(pattern, settings.choice)) {
    component_ = std::make_unique<DistributedSolver>(pattern);
    return;
  }
  // What wants memory does so before a run has begun, unless it may never be needed.
  const bool may_multigrid = settings.choice == SolverChoice::multigrid ||
                             (settings.choice == SolverChoice::automatic &&
                              may_pay({pattern.dim, static_cast<double>(pattern.n_entries())}));
  if (!may_multigrid)
    static_cast<void>(order());
}

LinearSolver::~LinearSolver() = default;

const std::vector<Index>& LinearSolver::order() {
  if (order_.empty()) {
    const Stopwatch watch(work_.analysis);
    order_ = fill_reducing_order(*pattern_);
  }
  return order_;
}

void LinearSolver::set_constrained(std::span<const char> constrained) {
  if (std::equal(constrained.begin(), constrained.end(), constrained_.begin(), constrained_.end()))
    return;
  constrained_.assign(constrained.begin(), constrained.end());
  // What knows of the fronts.
  if (last_ == single_.get() || last_ == cholmod_.get())
    last_ = nullptr;
  single_.reset();
  cholmod_.reset();
  elimination_.reset();
}

void LinearSolver::forget() {
  last_ = nullptr;
  reuse_ = {};
  factor_of_ = FactorOf::previous;
  backoff_.symmetric = {};
  backoff_.single = {};
  backoff_.multigrid = {};
  single_lu_serves_ = true;
  first_.clear();
  correction_ = 0.0;
}

template <class Make>
Factorization& LinearSolver::prepared(std::unique_ptr<Factorization>& factorization, Make make) {
  if (!factorization) {
    const Stopwatch watch(work_.analysis);
    factorization = make();
  }
  return *factorization;
}

void LinearSolver::release_all_but(const Factorization& factorization) {
  constexpr double few = 1e7; // entries: less memory than the matrices of a small problem take
  for (Factorization* other : {single_.get(), cholmod_.get(), mumps_symmetric_.get(),
                               mumps_single_.get(), mumps_.get(), umfpack_.get(), component_.get()})
    if (other != nullptr && other != &factorization && other->cost().entries > few)
      other->release();
}

bool LinearSolver::factorize(Factorization& factorization,
                             std::string_view method,
                             const SparseMatrix& matrix) {
  const Stopwatch watch(work_.factorization);
  last_ = nullptr;
  release_all_but(factorization);
  set_blas_threads(1); // threads are ours: a program that links the library may have asked for more
  const bool done = factorization.factorize(matrix);
  const FactorCost cost = factorization.cost();
  ++work_.factorizations;
  work_.flops += cost.flops;
  work_.last_method = method;
  work_.last_flops = cost.flops;
  work_.last_factor_bytes = cost.entries * static_cast<double>(cost.entry_size);
  if (done)
    last_ = &factorization;
  reuse_.begin(max_solves(cost));
  return done;
}

Outcome<SolveReport> LinearSolver::solve_with(Factorization& factorization,
                                              std::string_view method,
                                              const SparseMatrix& matrix,
                                              std::span<const double> rhs,
                                              std::span<double> x) {
  if (!factorize(factorization, method, matrix))
    return Failure{"the tangent is singular (" + std::string(method) + ")"};
  correction_ = 0.0; // of double precision
  auto report = back_substitute(factorization, method, matrix, rhs, x);
  if (report)
    factor_of_ = FactorOf::current;
  else
    last_ = nullptr;
  return report;
}

Outcome<SolveReport> LinearSolver::back_substitute(Factorization& factorization,
                                                   std::string_view method,
                                                   const SparseMatrix& matrix,
                                                   std::span<const double> rhs,
                                                   std::span<double> x) {
  const Stopwatch watch(work_.substitution);
  std::copy(rhs.begin(), rhs.end(), x.begin());
  factorization.solve(x);
  ++work_.substitutions;
  // Backward stable factorizations leave 1e-14 or so; one refinement repairs a poor pivot order.
  const double scale = norm(rhs);
  SolveReport report{method, 0.0};
  for (int pass = 0; pass < 2; ++pass) {
    matrix.multiply(x, residual_);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      residual_[i] = rhs[i] - residual_[i];
    report.relative_residual = scale > 0.0 ? norm(residual_) / scale : 0.0;
    if (report.relative_residual <= exact || pass == 1)
      break;
    factorization.solve(residual_);
    ++work_.substitutions;
    for (std::size_t i = 0; i < rhs.size(); ++i)
      x[i] += residual_[i];
  }
  if (!std::isfinite(report.relative_residual) || report.relative_residual > 1e-3)
    return Failure{"the linear system has no accurate solution (" + std::string(method) + ")"};
  return report;
}

/// Weights by which the norm of a residual is about the energy of what is missing: stiff contacts
/// do not drown the forces within the part. Where they are far stiffer than what is usual even that
/// asks too little of the part. (N.6)
///
/// @return a factor for the relative residual that will do, <= 1
double LinearSolver::weigh(const SparseMatrix& matrix) {
  const std::size_t n = residual_.size();
  if (n == 0)
    return 1.0;
  // Powers of two of the ratio: other units of length or force change nothing, to the bit.
  constexpr int most = 80;
  constexpr int usual = 7;                 // 4 to 7 with the penalties chosen by default
  constexpr std::size_t at_once = 1 << 12; // rows
  const std::vector<Index>& diagonal = pattern_->diagonal;
  const auto stiffness = [&](std::size_t i) { return std::abs(matrix.values[idx(diagonal[i])]); };
  const double largest = most_of_pieces(n, at_once, [&](std::size_t begin, std::size_t end) {
    double largest_here = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      largest_here = std::max(largest_here, stiffness(i));
    return largest_here;
  });
  weights_.resize(n);
  const double sum = sum_of_pieces(n, at_once, [&](std::size_t begin, std::size_t end) {
    long sum_here = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double ratio = largest / stiffness(i);
      const int below = std::min(exponent(ratio), most); // that of no number is larger
      weights_[i] = power_of_two(below / 2);
      sum_here += below;
    }
    return static_cast<double>(sum_here);
  });
  const auto mean = static_cast<int>(sum / static_cast<double>(n));
  return std::ldexp(1.0, std::min(0, usual - mean));
}

GmresReport LinearSolver::iterate(const SparseMatrix& matrix,
                                  std::span<const double> rhs,
                                  std::span<double> x,
                                  double tolerance,
                                  const Patience& patience,
                                  Known known) {
  const Stopwatch watch(work_.substitution);
  const double enough = std::max(weigh(matrix) * tolerance, exact);
  const GmresReport report =
      last_->iterate(gmres_, matrix, weights_, rhs, x, enough, patience, known);
  work_.substitutions += report.solves;
  return report;
}

Outcome<SolveReport> LinearSolver::solve(const SparseMatrix& matrix,
                                         bool symmetric,
                                         std::span<const double> rhs,
                                         std::span<double> x,
                                         const SolveOptions& options) {
  ++work_.systems;
  auto solved = solve_system(matrix, symmetric, rhs, x, options);
  if (solved && solved->method == with_earlier)
    ++work_.reused;
  return solved;
}

Outcome<SolveReport> LinearSolver::solve_system(const SparseMatrix& matrix,
                                                bool symmetric,
                                                std::span<const double> rhs,
                                                std::span<double> x,
                                                const SolveOptions& options) {
  factor_of_ = FactorOf::previous;
  if (norm(rhs) == 0.0) {
    std::fill(x.begin(), x.end(), 0.0);
    return SolveReport{"zero", 0.0};
  }
  DistributedSolver* all_processes = distributed();
  if (all_processes != nullptr)
    all_processes->expect_new_values();
  const bool may_reuse = options.tolerance > 0.0 &&
                         (settings_.choice == SolverChoice::automatic ||
                          settings_.choice == SolverChoice::multigrid || all_processes != nullptr);
  const int most = may_reuse && last_ != nullptr ? max_solves(last_->cost()) : 0;
  if (most > 0 && !reuse_.wants_new()) {
    const double enough = tolerance_for(options.tolerance, correction_, false);
    const GmresReport report = iterate(matrix, rhs, x, enough, {most}, {});
    if (report.converged) {
      reuse_.take(report.solves);
      return SolveReport{with_earlier, report.residual};
    }
  }
  return factorize_and_solve(matrix, symmetric, rhs, x, options);
}

Outcome<SolveReport> LinearSolver::solve_again(const SparseMatrix& matrix,
                                               bool symmetric,
                                               std::span<const double> rhs,
                                               std::span<double> x,
                                               double tolerance) {
  if (factor_of_ == FactorOf::current)
    return back_substitute(*last_, "again", matrix, rhs, x);
  if (factor_of_ == FactorOf::symmetrized) {
    const GmresReport report =
        iterate(matrix, rhs, x, tolerance_for(tolerance, correction_, false), with_neighbour, {});
    if (report.converged)
      return SolveReport{"again", report.residual};
  }
  return solve_system(matrix, symmetric, rhs, x, {tolerance});
}

const std::shared_ptr<const Elimination>& LinearSolver::elimination() {
  if (!elimination_) {
    const std::vector<Index>& fill_reducing = order();
    const Stopwatch watch(work_.analysis);
    elimination_ = std::make_shared<const Elimination>(*pattern_, fill_reducing, constrained_);
  }
  return elimination_;
}

bool LinearSolver::agrees_with_itself(const SparseMatrix& matrix, std::span<const double> rhs) {
  const Stopwatch watch(work_.substitution);
  first_.assign(2, std::vector<double>(rhs.begin(), rhs.end()));
  last_->solve(first_[0]);
  matrix.multiply(first_[0], first_[1]);
  for (std::size_t i = 0; i < rhs.size(); ++i)
    first_[1][i] = rhs[i] - first_[1][i];
  last_->solve(first_[1]);
  work_.substitutions += 2;
  correction_ = norm(first_[1]) / norm(first_[0]);
  return correction_ <= largest_correction; // false for NaN
}

bool LinearSolver::factorize_in_single(const SparseMatrix& matrix,
                                       std::span<const double> rhs,
                                       const SolveOptions& options) {
  const bool may = settings_.choice == SolverChoice::automatic ||
                   settings_.choice == SolverChoice::multigrid; // where that has failed
  if (!may || !backoff_.single.due())
    return false;
  const auto& fronts = elimination();
  Factorization& single = prepared(single_, [&] { return make_single(fronts); });
  // Where nothing happens the next matrix is much like the last.
  constexpr double far_from_bad = 0.1;
  const bool asks = !(options.tolerance > 0.0 && !options.far && last_ == &single &&
                      correction_ <= far_from_bad * good_correction);
  first_.clear();
  const bool serves =
      factorize(single, "ldlt-single", matrix) && (!asks || agrees_with_itself(matrix, rhs));
  if (!serves)
    last_ = nullptr;
  backoff_.single.take(serves);
  return serves;
}

Outcome<SolveReport> LinearSolver::solve_with_neighbour(std::string_view method,
                                                        const SparseMatrix& matrix,
                                                        std::span<const double> rhs,
                                                        std::span<double> x,
                                                        const SolveOptions& options,
                                                        Known known) {
  const bool small = max_solves(last_->cost()) == 0;
  const double enough = tolerance_for(options.tolerance, correction_, small);
  const GmresReport report = iterate(matrix, rhs, x, enough, with_neighbour, known);
  if (!report.converged) {
    last_ = nullptr;
    return Failure{"no convergence (" + std::string(method) + ")"};
  }
  factor_of_ = FactorOf::symmetrized;
  return SolveReport{method, report.residual};
}

Outcome<SolveReport> LinearSolver::solve_with_symmetric_part(const SparseMatrix& matrix,
                                                             std::span<const double> rhs,
                                                             std::span<double> x,
                                                             const SolveOptions& options) {
  matrix.take_symmetric_part(symmetric_part_);
  const auto attempt = [&]() -> Outcome<SolveReport> {
    if (factorize_in_single(symmetric_part_, rhs, options))
      return solve_with_neighbour("ldlt-single", matrix, rhs, x, options,
                                  Known(first_).first(first_.empty() ? 0 : 1));
    const auto& fronts = elimination();
    correction_ = 0.0;
    Factorization& cholesky = prepared(cholmod_, [&] { return make_cholmod(fronts); });
    if (!factorize(cholesky, "cholmod-gmres", symmetric_part_))
      return Failure{"the symmetric part is not positive definite"};
    return solve_with_neighbour("cholmod-gmres", matrix, rhs, x, options, {});
  };
  auto outcome = attempt();
  if (outcome)
    ++work_.nearly_symmetric;
  else
    free_memory(symmetric_part_.values); // LU needs the memory
  backoff_.symmetric.take(bool(outcome));
  return outcome;
}

Outcome<SolveReport> LinearSolver::solve_symmetric(const SparseMatrix& matrix,
                                                   std::span<const double> rhs,
                                                   std::span<double> x,
                                                   const SolveOptions& options) {
  if (factorize_in_single(matrix, rhs, options)) {
    // What is left of a solution that is exact but for rounding is the second direction.
    if (!first_.empty() && norm(first_[1]) == 0.0)
      first_.pop_back();
    auto outcome = solve_with_neighbour("ldlt-single", matrix, rhs, x, options, first_);
    if (outcome)
      return outcome;
  }
  const auto& fronts = elimination();
  return solve_with(prepared(cholmod_, [&] { return make_cholmod(fronts); }), "cholmod", matrix,
                    rhs, x);
}

Outcome<SolveReport> LinearSolver::factorize_and_solve(const SparseMatrix& matrix,
                                                       bool symmetric,
                                                       std::span<const double> rhs,
                                                       std::span<double> x,
                                                       const SolveOptions& options) {
  if (takes_multigrid() && backoff_.multigrid.due()) {
    auto outcome = solve_by_multigrid(matrix, rhs, x, options);
    backoff_.multigrid.take(bool(outcome));
    ++(outcome ? work_.multigrid : work_.multigrid_failed);
    if (outcome)
      return outcome;
    try {
      static_cast<void>(elimination());
    } catch (const std::bad_alloc&) { // nothing else can solve it: a shorter increment may
      backoff_.multigrid = {};
      return outcome;
    }
  }
  if (distributed() != nullptr)
    return solve_distributed(matrix, symmetric, rhs, x, options);
  const bool fast = settings_.choice == SolverChoice::automatic ||
                    settings_.choice == SolverChoice::cholmod ||
                    settings_.choice == SolverChoice::multigrid; // where it has failed
  if (symmetric && fast) {
    auto outcome = solve_symmetric(matrix, rhs, x, options);
    if (outcome)
      return outcome;
  }
  if (!symmetric && fast && backoff_.symmetric.due()) {
    auto outcome = solve_with_symmetric_part(matrix, rhs, x, options);
    if (outcome)
      return outcome;
  }
  if (!symmetric && fast && single_lu_serves_ &&
      max_solves({elimination()->flops(), elimination()->entries()}) > 0) {
    Factorization& lu =
        prepared(mumps_single_, [&] { return make_single_mumps(*pattern_, order()); });
    correction_ = 0.0;
    if (factorize(lu, "mumps-lu-gmres", matrix)) {
      auto outcome = solve_with_neighbour("mumps-lu-gmres", matrix, rhs, x, {exact}, {});
      if (outcome)
        return outcome;
    }
    single_lu_serves_ = false;
  }
  if (settings_.choice != SolverChoice::umfpack) {
    Factorization& mumps = prepared(symmetric ? mumps_symmetric_ : mumps_,
                                    [&] { return make_mumps(*pattern_, order(), symmetric); });
    auto outcome = solve_with(mumps, symmetric ? "mumps-ldlt" : "mumps-lu", matrix, rhs, x);
    if (outcome || settings_.choice == SolverChoice::mumps)
      return outcome;
  }
  Factorization& umfpack = prepared(umfpack_, [&] { return make_umfpack(*pattern_, order()); });
  return solve_with(umfpack, "umfpack", matrix, rhs, x);
}

} // namespace billet::mechanics
