// How far to go along a correction. (N.9)

#include "geometry/base/stopwatch.h"
#include "mechanics/equilibrium/newton.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::mechanics {

Outcome<Newton::Evaluation> Newton::try_step(std::span<ForceTerm* const> terms,
                                             const Trial& trial,
                                             std::vector<double>& x,
                                             double step,
                                             bool forces_only) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = base_[i] + step * correction_[i];
  const auto norms = evaluate(terms, trial, forces_only);
  if (!norms)
    return norms.error();
  contact_changes_ += system_.contact_changes;
  return Evaluation{*norms, slope()};
}

double Newton::nonsmooth_slope(std::span<ForceTerm* const> terms,
                               const Trial& trial,
                               std::vector<double>& x,
                               double step) {
  const Stopwatch watch(times_.assembly);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = base_[i] + step * correction_[i];
  system_.forces_only = true; // no solution follows before all is assembled anew
  system_.clear();
  for (ForceTerm* term : terms)
    if (term->nonsmooth() && !term->assemble(trial, system_))
      return 0.0; // the whole system will say why
  contact_changes_ += system_.contact_changes;
  return slope();
}

Outcome<Newton::Evaluation> Newton::search(std::span<ForceTerm* const> terms,
                                           const Trial& trial,
                                           std::vector<double>& x,
                                           const Norms& before,
                                           bool forces_only,
                                           double& step) {
  constexpr double shrunk = 0.6; // of the residual left after a full step: no search then
  constexpr double enough = 0.5; // of the slope left after a full step: nor then
  base_ = x;
  const double start = slope();
  step = 1.0;
  contact_changes_ = 0;
  auto now = try_step(terms, trial, x, step, forces_only);
  constexpr double shortest = 1.0 / 64.0;
  while (!now && step > shortest) {
    step *= 0.5; // an element turned inside out: nothing but a shorter step can help
    now = try_step(terms, trial, x, step);
  }
  if (!now || now->norms.residual <= shrunk * before.residual ||
      std::abs(now->slope) <= enough * std::abs(start) || (now->slope > 0.0) == (start > 0.0))
    return now;
  return close_in(terms, trial, x, start, *now, step);
}

/// The work of the correction changes its sign between 0 and `step`: closes in on that place, also
/// across the kink of a contact that opens or closes, to go on with the far side's tangent.
///
/// Contact makes it nonsmooth and costs next to nothing: it is found anew in every trial, the rest
/// drawn as a line between the steps where everything was assembled. (N.9)
///
/// @param start  slope at 0
/// @param far    what was found at `step`
Outcome<Newton::Evaluation> Newton::close_in(std::span<ForceTerm* const> terms,
                                             const Trial& trial,
                                             std::vector<double>& x,
                                             double start,
                                             const Evaluation& far,
                                             double& step) {
  constexpr double close = 0.2; // of the slope left after closing in
  constexpr int max_trials = 10;
  struct End {
    double step;
    double slope;
    double rest; // of the slope, without nonsmooth terms
  };
  const auto nonsmooth = [&](double s) { return nonsmooth_slope(terms, trial, x, s); };
  End near_end{0.0, start, start - nonsmooth(0.0)};
  End far_end{step, far.slope, far.slope - nonsmooth(step)};
  int trials = 0;
  while (true) {
    double low = near_end.step, slope_low = near_end.slope;
    double high = far_end.step, slope_high = far_end.slope;
    double bent = 0.0;
    for (bool found = false; !found && trials < max_trials; ++trials) {
      const double secant = low + (high - low) * slope_low / (slope_low - slope_high);
      step = std::clamp(secant, low + 0.1 * (high - low), high - 0.1 * (high - low));
      bent = nonsmooth(step);
      const double share = (step - near_end.step) / (far_end.step - near_end.step);
      const double estimate = bent + near_end.rest + share * (far_end.rest - near_end.rest);
      found = std::abs(estimate) <= close * std::abs(start);
      const bool same_side = (estimate > 0.0) == (start > 0.0);
      (same_side ? low : high) = step;
      (same_side ? slope_low : slope_high) = estimate;
      // Illinois: the end that stays put loses weight, or the secant would creep.
      (same_side ? slope_high : slope_low) *= 0.5;
    }
    auto now = try_step(terms, trial, x, step);
    if (!now || std::abs(now->slope) <= close * std::abs(start) || trials == max_trials)
      return now;
    const bool same_side = (now->slope > 0.0) == (start > 0.0);
    (same_side ? near_end : far_end) = {step, now->slope, now->slope - bent};
  }
}

} // namespace billet::mechanics
