// Newton-Raphson iteration for one increment.
//
// Finds positions at which the sum of all force terms vanishes at every free unknown while the
// prescribed unknowns sit where they are told to. The tangent is exact, so the last iterations
// converge quadratically; far from the solution a line search on the work of the correction keeps
// the iteration together. Theory: docs/theory/mechanics.md (N.1)-(N.9).

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/equilibrium/force_term.h"
#include "mechanics/linear/coupled_solver.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace billet::mechanics {

/// When an increment counts as solved, and when it is given up.
struct NewtonSettings {
  double tolerance = 1e-6; ///< residual over the largest internal or contact force [-]
  int max_iterations = 24;
  double force_floor = 0.0; ///< forces below it count as zero: an unloaded state converges [N]
  double largest_correction = HUGE_VAL; ///< a longer one means that nothing holds the body [mm]
};

/// Prescribed unknowns at the end of the increment.
struct Prescribed {
  std::vector<Index> unknowns;   ///< sorted
  std::vector<double> positions; ///< where they must be [mm]
};

/// One line of iterations.csv.
struct IterationRecord {
  int iteration;           ///< from 0: the first guess
  double residual;         ///< relative to the force scale [-]
  double correction;       ///< largest correction over the largest displacement so far [-]
  double step;             ///< fraction of the correction taken [-]
  std::string_view solver; ///< factorization used
  int contact_changes = 0; ///< contact points of another status than in the trial before, summed
                           ///< over the trials of a line search
};

/// An increment solved.
struct NewtonReport {
  int iterations = 0;       ///< linear systems solved
  double residual = 0.0;    ///< at the end, relative [-]
  double force_scale = 0.0; ///< [N]
};

/// Times spent, summed over calls [s].
struct NewtonTimes {
  double assembly = 0.0;
  double solve = 0.0;
};

/// What is continued to the full problem on the way to a solution, or is given more time.
enum class Continuation {
  none,     ///< from a first guess
  friction, ///< from a first guess, by way of the solution with a softer resistance to slip
  /// From the start of the increment, with a softer resistance to penetration, too.
  penalty_and_friction,
  /// From a first guess, however long it takes: metal snaps, no increment is short.
  more_iterations,
  /// From what solves terms that have changed a little since; goes on recording.
  from_solution,
};

/// The iteration, with the memory it works in.
class Newton {
public:
  /// @param n_extra  unknowns of the terms' own after those of the nodes: see `Border`
  /// @pre pattern outlives this
  Newton(const BlockPattern& pattern,
         SolverSettings solver,
         NewtonSettings settings,
         std::size_t n_extra = 0);

  /// Forces below it count as zero from here on [N].
  void set_force_floor(double force) { settings_.force_floor = force; }

  /// Solves for `x`.
  ///
  /// @param terms    every contribution; the first is the bulk
  /// @param x        in: first guess; out: solution, or the last trial on failure
  /// @return the reason when the increment has no solution in reach: take a shorter one
  [[nodiscard]] Outcome<NewtonReport> solve(std::span<ForceTerm* const> terms,
                                            const Prescribed& prescribed,
                                            double time_old,
                                            double time,
                                            std::span<const double> x_old,
                                            std::vector<double>& x,
                                            Continuation continuation = Continuation::none);

  /// Goes on as if this were its first call: what the next ones do depends on no earlier one.
  void forget();

  /// Iterations of the last call, and of those that its solution came from.
  [[nodiscard]] const std::vector<IterationRecord>& records() const { return records_; }
  /// Residual of the last trial [N]; at prescribed unknowns: the force of the support.
  [[nodiscard]] std::span<const double> residual() const { return system_.residual; }
  [[nodiscard]] const NewtonTimes& times() const { return times_; }
  [[nodiscard]] SolverWork solver_work() const { return solver_.work(); }
  /// Free unknown of a node with the largest residual of the last trial (for a post-mortem).
  [[nodiscard]] Index worst_unknown() const;

private:
  class Increment;
  struct Norms {
    double residual; ///< over the free unknowns [N]
    double scale;    ///< largest internal or contact force [N]
  };
  struct Evaluation {
    Norms norms;
    double slope; ///< work of the correction against the residual [N mm]
  };
  [[nodiscard]] Outcome<Norms>
  evaluate(std::span<ForceTerm* const> terms, const Trial& trial, bool forces_only = false);
  [[nodiscard]] Outcome<SolveReport>
  correct(const Prescribed& prescribed, std::span<const double> x, const SolveOptions& options);
  [[nodiscard]] Outcome<SolveReport> solve_bordered(const SolveOptions& options);
  [[nodiscard]] Outcome<Evaluation> search(std::span<ForceTerm* const> terms,
                                           const Trial& trial,
                                           std::vector<double>& x,
                                           const Norms& before,
                                           bool forces_only,
                                           double& step);
  [[nodiscard]] Outcome<Evaluation> try_step(std::span<ForceTerm* const> terms,
                                             const Trial& trial,
                                             std::vector<double>& x,
                                             double step,
                                             bool forces_only = false);
  /// What nonsmooth terms have in the slope after a step; the system is theirs alone then.
  [[nodiscard]] double nonsmooth_slope(std::span<ForceTerm* const> terms,
                                       const Trial& trial,
                                       std::vector<double>& x,
                                       double step);
  [[nodiscard]] Outcome<Evaluation> close_in(std::span<ForceTerm* const> terms,
                                             const Trial& trial,
                                             std::vector<double>& x,
                                             double start,
                                             const Evaluation& far,
                                             double& step);
  [[nodiscard]] double slope() const;
  [[nodiscard]] double rounding_of_forces(double position) const;
  /// Cuts the correction to a share of what the increment has moved so far. (N.8)
  void limit_correction(std::span<const double> x_old, std::span<const double> x);
  /// Whether the correction was longer than any can be, and has been cut.
  [[nodiscard]] bool shorten_correction();
  void mark(const Prescribed& prescribed);

  const BlockPattern* pattern_;
  NewtonSettings settings_;
  CoupledSolver solver_;
  System system_;
  std::vector<char> fixed_;
  std::vector<char> beside_fixed_; ///< rows with a prescribed unknown in them
  std::vector<double> rhs_;
  std::vector<double> correction_;
  std::vector<double> base_;
  std::vector<IterationRecord> records_;
  int contact_changes_ = 0; ///< of the trials of this iteration
  NewtonTimes times_;
  bool settled_ = false; ///< the last correction did what a quadratic iteration should
};

} // namespace billet::mechanics
