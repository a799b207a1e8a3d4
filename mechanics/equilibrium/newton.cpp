#include "mechanics/equilibrium/newton.h"

#include "geometry/base/pieces.h"
#include "geometry/base/stopwatch.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace billet::mechanics {

namespace {

double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

double largest(std::span<const double> v) {
  double most = 0.0;
  for (const double value : v)
    most = std::max(most, std::abs(value));
  return most;
}

/// A trial that still is this far off after so many iterations has lost its way: a shorter
/// increment costs less than going on. (N.5) Measured on 5400 tries of eleven cases: of 570 that
/// failed 435 come to the first mark, of 4840 that come through 8.
bool hopeless(Continuation continuation, int iterations, double relative_residual) {
  if (continuation == Continuation::more_iterations)
    return false;
  return (iterations >= 8 && relative_residual > 0.9) ||
         (iterations >= 10 && relative_residual > 0.3) ||
         (iterations >= 14 && relative_residual > 1e-2);
}

/// Relative residual a correction is solved to: so small that the iteration still converges
/// quadratically, and no smaller than the increment needs. (N.6) Eisenstat and Walker (1996)
double forcing(double relative_residual, double tolerance) {
  constexpr double coarsest = 1e-3;
  constexpr double below_tolerance = 0.1;
  return std::min(coarsest,
                  std::max(relative_residual, below_tolerance * tolerance / relative_residual));
}

/// What is left of the relative residual after an iteration that converges quadratically, as the
/// last one did; on the safe side.
double expected_residual(double before, double now) {
  constexpr double safety = 10.0;
  const double rate = now / before;
  return safety * rate * rate * now;
}

/// Ten times stiffer whenever the residual is small. (N.10)
Softening first_softening(Continuation continuation) {
  constexpr double soft = 1e-3, gentle = 1e-4;
  if (continuation == Continuation::friction)
    return {soft, 1.0};
  if (continuation == Continuation::penalty_and_friction)
    return {gentle, gentle};
  return {};
}

void harden(Softening& softening) {
  constexpr double stiffer = 10.0;
  softening.slip = std::min(1.0, stiffer * softening.slip);
  softening.penetration = std::min(1.0, stiffer * softening.penetration);
}

/// Times the usual number.
int iterations_for(Continuation continuation) {
  constexpr int friction = 2, penalty_and_friction = 4, more_iterations = 4;
  switch (continuation) {
  case Continuation::friction:
    return friction;
  case Continuation::penalty_and_friction:
    return penalty_and_friction;
  case Continuation::more_iterations:
    return more_iterations;
  case Continuation::none:
  case Continuation::from_solution:
    break;
  }
  return 1;
}

constexpr std::size_t rows_at_once = 2048; ///< of the tangent, that a thread takes

} // namespace

Newton::Newton(const BlockPattern& pattern,
               SolverSettings solver,
               NewtonSettings settings,
               std::size_t n_extra)
    : pattern_(&pattern), settings_(settings), solver_(pattern, solver) {
  const auto n = idx(pattern.n_dofs());
  system_.tangent.pattern = &pattern;
  system_.tangent.values.resize(pattern.n_entries());
  system_.borders.resize(n_extra);
  for (Border& border : system_.borders) {
    border.column.resize(n);
    border.row.resize(n);
    border.corner.resize(n_extra);
  }
  system_.residual.resize(n + n_extra);
  fixed_.resize(n + n_extra);
  beside_fixed_.resize(n);
  rhs_.resize(n);
  correction_.resize(n + n_extra);
}

void Newton::mark(const Prescribed& prescribed) {
  std::fill(fixed_.begin(), fixed_.end(), char{0});
  for (const Index i : prescribed.unknowns)
    fixed_[idx(i)] = 1;
  const auto is_fixed = [this](Index j) { return fixed_[idx(j)] != 0; };
  for_pieces(beside_fixed_.size(), rows_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = pattern_->columns.begin() + pattern_->row_start[i];
      const auto last = pattern_->columns.begin() + pattern_->row_start[i + 1];
      beside_fixed_[i] = std::any_of(first, last, is_fixed) ? 1 : 0;
    }
  });
  solver_.set_constrained(std::span<const char>(fixed_).first(beside_fixed_.size()));
}

Outcome<Newton::Norms>
Newton::evaluate(std::span<ForceTerm* const> terms, const Trial& trial, bool forces_only) {
  const Stopwatch watch(times_.assembly);
  system_.forces_only = forces_only;
  system_.clear();
  double scale = settings_.force_floor;
  for (ForceTerm* term : terms) {
    const auto outcome = term->assemble(trial, system_);
    if (!outcome)
      return outcome.error();
    double sum = 0.0;
    for (const double r : system_.residual)
      sum += r * r;
    scale = std::max(scale, std::sqrt(sum));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i] == 0)
      sum += system_.residual[i] * system_.residual[i];
  if (!std::isfinite(sum))
    return Failure{"the residual is not finite"};
  return Norms{std::sqrt(sum), scale};
}

/// What the rounding of positions of this size makes of the forces of stiff elements. [N]
double Newton::rounding_of_forces(double position) const {
  const auto squares_of = [&](std::size_t begin, std::size_t end) {
    double squares = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double stiffness = system_.tangent.values[idx(pattern_->diagonal[i])];
      squares += fixed_[i] == 0 ? stiffness * stiffness : 0.0;
    }
    return squares;
  };
  const double squares = sum_of_pieces(pattern_->diagonal.size(), rows_at_once, squares_of);
  return std::numeric_limits<double>::epsilon() * position * std::sqrt(squares);
}

double Newton::slope() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i] == 0)
      sum += correction_[i] * system_.residual[i];
  return sum;
}

Outcome<SolveReport> Newton::correct(const Prescribed& prescribed,
                                     std::span<const double> x,
                                     const SolveOptions& options) {
  const Stopwatch watch(times_.solve);
  auto& values = system_.tangent.values;
  std::fill(correction_.begin(), correction_.end(), 0.0);
  for (std::size_t k = 0; k < prescribed.unknowns.size(); ++k) {
    const auto i = idx(prescribed.unknowns[k]);
    correction_[i] = prescribed.positions[k] - x[i];
  }
  // Prescribed unknowns become rows and columns of the identity, scaled like their neighbours.
  const auto separate = [&](std::size_t i) {
    double lift = 0.0;
    for (Index k = pattern_->row_start[i]; k < pattern_->row_start[i + 1]; ++k) {
      const auto j = idx(pattern_->columns[idx(k)]);
      double& value = values[idx(k)];
      if (i == j) {
        if (fixed_[i] != 0)
          rhs_[i] = correction_[i] * (value = std::abs(value) > 0.0 ? std::abs(value) : 1.0);
        continue;
      }
      if (fixed_[i] == 0 && fixed_[j] != 0)
        lift += value * correction_[j];
      if (fixed_[i] != 0 || fixed_[j] != 0)
        value = 0.0;
    }
    if (fixed_[i] == 0)
      rhs_[i] = -system_.residual[i] - lift;
  };
  for_pieces(rhs_.size(), rows_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (beside_fixed_[i] == 0)
        rhs_[i] = -system_.residual[i];
      else
        separate(i);
  });
  std::erase_if(system_.tangent.unsymmetric, [&](const EntryPart& part) {
    return fixed_[idx(part.row)] != 0 || fixed_[idx(pattern_->columns[idx(part.entry)])] != 0;
  });
  std::erase_if(system_.couplings, [&](const Coupling& coupling) {
    const auto i = idx(coupling.row), j = idx(coupling.column);
    if (fixed_[i] == 0 && fixed_[j] != 0)
      rhs_[i] -= coupling.value * correction_[j];
    return fixed_[i] != 0 || fixed_[j] != 0;
  });
  SolveOptions here = options;
  here.positions = x.first(rhs_.size());
  return solve_bordered(here);
}

/// Eliminates the nodes: one more right-hand side for each unknown that belongs to none. (N.7)
Outcome<SolveReport> Newton::solve_bordered(const SolveOptions& options) {
  const std::size_t n = rhs_.size();
  const std::size_t m = system_.borders.size();
  const std::span<double> nodal = std::span(correction_).first(n);
  auto solved =
      solver_.solve(system_.tangent, system_.couplings, system_.symmetric, rhs_, nodal, options);
  const bool held = std::all_of(fixed_.begin() + static_cast<std::ptrdiff_t>(n), fixed_.end(),
                                [](char fixed) { return fixed != 0; });
  if (!solved || held) // they are where they have been told to be: none follows its load
    return solved;
  // A tool in equilibrium between its load and contact is moved by the small rest of both.
  constexpr double of_columns = 1e-6;
  std::vector<std::vector<double>> influence(m, std::vector<double>(n));
  Eigen::MatrixXd reduced(m, m);
  Eigen::VectorXd rest(m);
  for (std::size_t j = 0; j < m; ++j) {
    std::vector<double>& column = system_.borders[j].column;
    for (std::size_t i = 0; i < n; ++i)
      if (fixed_[i] != 0)
        column[i] = 0.0;
    const auto again =
        solver_.solve_again(system_.tangent, system_.symmetric, column, influence[j], of_columns);
    if (!again)
      return again.error();
  }
  for (std::size_t i = 0; i < m; ++i) {
    const Border& border = system_.borders[i];
    rest[static_cast<Index>(i)] = -system_.residual[n + i] - product(border.row, nodal);
    for (std::size_t j = 0; j < m; ++j)
      reduced(static_cast<Index>(i), static_cast<Index>(j)) =
          border.corner[j] - product(border.row, influence[j]);
  }
  const Eigen::VectorXd extra = reduced.fullPivLu().solve(rest);
  if (!extra.allFinite())
    return Failure{"a driven tool has nothing to push against"};
  // Where every point slips nothing holds a driven tool in the linear equations: it is moved a
  // little way, to where points stick.
  constexpr double share = 0.01;
  const double farthest = share * settings_.largest_correction;
  for (std::size_t j = 0; j < m; ++j) {
    correction_[n + j] = std::clamp(extra[static_cast<Index>(j)], -farthest, farthest);
    for (std::size_t i = 0; i < n; ++i)
      correction_[i] -= influence[j][i] * correction_[n + j];
  }
  return solved;
}

/// An increment on its way to equilibrium.
class Newton::Increment {
public:
  Increment(Newton& newton,
            std::span<ForceTerm* const> terms,
            const Prescribed& prescribed,
            const Trial& trial,
            std::vector<double>& x,
            Continuation continuation)
      : newton_(newton), terms_(terms), prescribed_(prescribed), time_old_(trial.time_old),
        time_(trial.time), x_old_(trial.x_old), x_(x), continuation_(continuation),
        guessed_(continuation != Continuation::from_solution),
        softening_(first_softening(continuation)) {}

  [[nodiscard]] Outcome<NewtonReport> solve() {
    if (const Outcome<Done> begun = begin(); !begun)
      return begun.error();
    const int max_iterations = iterations_for(continuation_) * newton_.settings_.max_iterations;
    for (int iteration = 1; iteration <= max_iterations; ++iteration) {
      if (const Outcome<Done> hardened = harden_if_near(iteration); !hardened)
        return hardened.error();
      const double relative = this->relative();
      const bool well = is_solved_well(iteration, relative);
      if (!well && newton_.system_.forces_only) // it was not the last one
        if (const Outcome<Done> evaluated = evaluate(); !evaluated)
          return evaluated.error();
      if ((well || (softening_.slip == 1.0 && is_at_rounding(relative))) && missing() == 0.0)
        return NewtonReport{iteration - 1, relative, norms_.scale};
      if (hopeless(continuation_, iteration - 1 - hardened_, relative))
        return Failure{"no convergence"};
      if (const Outcome<Done> corrected = correct(iteration, relative); !corrected)
        return corrected.error();
    }
    if (softening_.slip == 1.0 && relative() <= newton_.settings_.tolerance && missing() == 0.0)
      return NewtonReport{newton_.settings_.max_iterations, relative(), norms_.scale};
    return Failure{"no convergence"};
  }

private:
  [[nodiscard]] Trial trial(bool first_guess = false) const {
    return Trial{time_old_, time_, x_old_, x_, softening_, first_guess};
  }
  [[nodiscard]] double relative() const { return norms_.residual / norms_.scale; }

  Outcome<Done> evaluate(bool first_guess = false) {
    const Outcome<Norms> norms = newton_.evaluate(terms_, trial(first_guess));
    if (!norms)
      return norms.error();
    norms_ = *norms;
    return Done{};
  }

  Outcome<Done> begin() {
    if (guessed_)
      newton_.records_.clear();
    newton_.mark(prescribed_);
    if (!evaluate(guessed_)) {
      // The extrapolated guess was too bold: start from the committed state.
      x_.assign(x_old_.begin(), x_old_.end());
      if (const Outcome<Done> evaluated = evaluate(true); !evaluated)
        return evaluated.error();
    }
    newton_.records_.push_back({0, relative(), 0.0, 0.0, "", newton_.system_.contact_changes});
    residuals_.assign(1, norms_.residual);
    position_ = std::max(largest(x_old_), 0.5 * largest(x_)); // it may come from far
    before_ = relative();
    return Done{};
  }

  /// Each of two sets of contacts leads to the other: the last residuals are those of two
  /// iterations before. (N.9a)
  [[nodiscard]] bool goes_to_and_fro() const {
    const std::size_t rounds = 2 + turns_ % 2; // a way out there may be from one of them only
    constexpr double same = 0.003;
    const std::vector<double>& all = residuals_;
    if (missing() > 0.0 || all.size() < rounds + 2)
      return false;
    for (std::size_t i = all.size() - rounds; i < all.size(); ++i)
      if (std::abs(all[i] - all[i - 2]) > same * all[i])
        return false;
    return true;
  }

  /// Half of the correction, the third and fourth time a quarter, and so on. (N.9a)
  Outcome<Evaluation> half_way(double& step) {
    step = std::ldexp(0.5, -static_cast<int>(turns_++ / 2));
    newton_.base_ = x_;
    newton_.contact_changes_ = 0;
    return newton_.try_step(terms_, trial(), x_, step);
  }

  /// How far unknowns are from what is prescribed [mm].
  [[nodiscard]] double missing() const {
    double most = 0.0;
    for (std::size_t k = 0; k < prescribed_.unknowns.size(); ++k)
      most = std::max(most, std::abs(prescribed_.positions[k] - x_[idx(prescribed_.unknowns[k])]));
    return most;
  }

  /// Stiff penalties and near incompressibility turn the rounding of coordinates into forces above
  /// the tolerance; when the correction is no more than that rounding, no better x can be written.
  /// Nor when the residual is: a slender body turns such forces into corrections of any length.
  [[nodiscard]] bool is_at_rounding(double relative) const {
    constexpr double plausible = 1e-2;
    const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * position_;
    return relative <= plausible &&
           (taken_ <= rounding || norms_.residual <= newton_.rounding_of_forces(position_));
  }

  Outcome<Done> harden_if_near(int iteration) {
    constexpr double near = 1e-4;
    if (softening_.slip == 1.0 || relative() > near)
      return Done{};
    harden(softening_);
    if (continuation_ == Continuation::penalty_and_friction)
      hardened_ = iteration - 1;
    return evaluate();
  }

  [[nodiscard]] bool is_solved_well(int iteration, double relative) const {
    // What the next correction would be, from the way the residual shrank.
    const double next = before_ > 0.0 ? correction_ * std::min(1.0, relative / before_) : 0.0;
    constexpr double small_correction = 1e-5;
    // Of a guess it is not known how long its correction would be: a slender body bends far under
    // forces that are small compared with those within it.
    constexpr double of_a_guess = 1e-3;
    const bool is_guess = guessed_ && iteration == 1;
    const double allowed = (is_guess ? of_a_guess : 1.0) * newton_.settings_.tolerance;
    return softening_.slip == 1.0 && relative <= allowed && next <= small_correction;
  }

  Outcome<Done> correct(int iteration, double relative) {
    constexpr int max_shortened = 8;
    const double tolerance = newton_.settings_.tolerance;
    const bool expected_last = newton_.settled_ && softening_.slip == 1.0 && missing() == 0.0 &&
                               expected_residual(before_, relative) <= tolerance;
    before_ = relative;
    // After an event - a contact that opens or closes, a line search - the tangent is another.
    const auto solved = newton_.correct(
        prescribed_, x_, SolveOptions{forcing(relative, tolerance), !newton_.settled_});
    if (!solved)
      return solved.error();
    if (iteration > 1 && missing() == 0.0)
      newton_.limit_correction(x_old_, x_);
    if (newton_.shorten_correction() && ++shortened_ > max_shortened)
      return Failure{"the workpiece, or part of it, moves away freely: nothing holds it"};
    // While supports still move their work is unknown to the search: it takes the whole step.
    // So it does where contacts were kept: the residual is not that of the real contacts.
    const bool whole = missing() > 0.0 || newton_.system_.kept_contacts;
    const Norms reference = whole ? Norms{HUGE_VAL, norms_.scale} : norms_;
    double step = 1.0;
    const auto evaluation =
        goes_to_and_fro() ? half_way(step)
                          : newton_.search(terms_, trial(), x_, reference, expected_last, step);
    if (!evaluation)
      return evaluation.error();
    if (step == 1.0)
      for (std::size_t k = 0; k < prescribed_.unknowns.size(); ++k)
        x_[idx(prescribed_.unknowns[k])] = prescribed_.positions[k]; // to the bit
    norms_ = evaluation->norms;
    constexpr double shrinks = 0.2;
    newton_.settled_ = step == 1.0 && norms_.residual < shrinks * relative * norms_.scale;
    const double moved = largest_difference(x_, x_old_);
    // The whole of it: a step may be short for want of a way down.
    taken_ = largest(newton_.correction_);
    correction_ = moved > 0.0 ? step * largest(newton_.correction_) / moved : 0.0;
    newton_.records_.push_back(
        {iteration, this->relative(), correction_, step, solved->method, newton_.contact_changes_});
    residuals_.push_back(norms_.residual);
    return Done{};
  }

  Newton& newton_;
  std::span<ForceTerm* const> terms_;
  const Prescribed& prescribed_;
  double time_old_;
  double time_;
  std::span<const double> x_old_;
  std::vector<double>& x_;
  Continuation continuation_;
  bool guessed_;
  Softening softening_;
  Norms norms_{0.0, 1.0};
  double position_ = 0.0;         ///< the largest [mm]
  double before_ = 0.0;           ///< relative residual of the iteration before
  double taken_ = HUGE_VAL;       ///< length of the last correction [mm]
  double correction_ = 0.0;       ///< the same, over what has moved [-]
  std::vector<double> residuals_; ///< at the start and after each iteration [N]
  std::size_t turns_ = 0;         ///< how often it went to and fro
  int shortened_ = 0;             ///< corrections that were cut
  int hardened_ = 0;              ///< the iteration that the last softness was left at
};

Outcome<NewtonReport> Newton::solve(std::span<ForceTerm* const> terms,
                                    const Prescribed& prescribed,
                                    double time_old,
                                    double time,
                                    std::span<const double> x_old,
                                    std::vector<double>& x,
                                    Continuation continuation) {
  return Increment(*this, terms, prescribed, {time_old, time, x_old, x, {}}, x, continuation)
      .solve();
}

void Newton::limit_correction(std::span<const double> x_old, std::span<const double> x) {
  constexpr double share_of_way = 0.1;
  // However short the increment, a contact that changes may need that much.
  constexpr double share_of_body = 1e-4;
  double moved = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    moved += (x[i] - x_old[i]) * (x[i] - x_old[i]);
    length += correction_[i] * correction_[i];
  }
  const double allowed =
      std::max(share_of_way * std::sqrt(moved), share_of_body * settings_.largest_correction *
                                                    std::sqrt(static_cast<double>(x.size())));
  if (length > allowed * allowed)
    for (double& value : correction_)
      value *= allowed / std::sqrt(length);
}

bool Newton::shorten_correction() {
  // Where all contact points slip hardly anything holds a body that only friction holds: it is
  // moved a little way at a time, to where points stick.
  constexpr double share = 0.01;
  const double longest = largest(correction_);
  if (longest <= settings_.largest_correction)
    return false;
  for (double& value : correction_)
    value *= share * settings_.largest_correction / longest;
  return true;
}

void Newton::forget() {
  solver_.forget();
  settled_ = false;
}

Index Newton::worst_unknown() const {
  Index worst = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < rhs_.size(); ++i)
    if (fixed_[i] == 0 && std::abs(system_.residual[i]) > most) {
      most = std::abs(system_.residual[i]);
      worst = static_cast<Index>(i);
    }
  return worst;
}

} // namespace billet::mechanics
