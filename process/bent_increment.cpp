#include "process/bent_increment.h"

#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace billet::process {

namespace {

/// Mises stress over flow stress at the end of the trial, on average over the part: 1 where all of
/// it flows [-].
double average_effort(const mechanics::Bulk& bulk) {
  double sum = 0.0;
  for (std::size_t k = 0; k < bulk.volumes().size(); ++k) {
    const mechanics::MisesStress now = bulk.trial_stress(k);
    sum += bulk.volumes()[k] * now.stress / now.flow_stress;
  }
  return sum / bulk.reference_volume();
}

} // namespace

double bend_from_nothing(double trapezoid, double work) {
  constexpr double least = 0.125, most = 0.875; // both parts are worth an increment
  constexpr double steps = 64.0; // rounding, in other units or of another machine, is lost in them
  const double ratio = work / trapezoid;
  const double share = std::clamp(ratio > 1.0 ? 2.0 - ratio : 1.0 - ratio, least, most);
  return std::round(steps * share) / steps;
}

std::optional<Bend> Process::bend_within(double dt, double length, double shortest) const {
  constexpr double early = 0.1;       // of the run: later ones are compared with its work so far
  constexpr double short_share = 0.1; // of the longest by default: no shorter for that
  constexpr double most = 1e-3;       // of the work of a stage that goes on like this
  constexpr double much = 0.25; // of the flow stress: the force of contact that grows is little yet
  constexpr double nothing = 0.01; // of the work of the increment: what was done before
  if (state_.time >= early * scene_.stages.back().end ||
      dt <= short_share * default_longest(length))
    return std::nullopt;
  const EnergyBalance after = energy_after(dt);
  const double missed = after.missing() - state_.energy.missing();
  const double work = after.largest_since(state_.energy);
  const double expected = std::max(state_.works.most, work * length / dt);
  if (std::abs(missed) <= std::max(most * expected, work_of_rounding()) ||
      average_effort(*bulk_) < much)
    return std::nullopt;
  constexpr double half = 0.5;
  const double trapezoid = after.external - state_.energy.external;
  const double share =
      state_.works.most < nothing * work ? bend_from_nothing(trapezoid, trapezoid - missed) : half;
  if (std::min(share, 1.0 - share) * dt < shortest)
    return std::nullopt;
  return Bend{share, fmt::format("its balance of energy misses {:.2g} % of a stage that goes on "
                                 "like it: in two parts",
                                 100.0 * std::abs(missed) / expected)};
}

} // namespace billet::process
