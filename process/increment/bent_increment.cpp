#include "process/increment/bent_increment.h"

#include "geometry/base/pieces.h"
#include "process/energy/balance.h"
#include "process/reports/energy_balance.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace billet::process {

namespace {

/// Mises stress over flow stress at the end of the trial, on average over the part: 1 where all of
/// it flows [-].
double average_effort(const mechanics::Bulk& bulk) {
  constexpr std::size_t points_at_once = 1024;
  const double sum =
      sum_of_pieces(bulk.volumes().size(), points_at_once, [&](std::size_t begin, std::size_t end) {
        double part = 0.0;
        for (std::size_t k = begin; k < end; ++k) {
          const mechanics::MisesStress now = bulk.trial_stress(k);
          part += bulk.volumes()[k] * now.stress / now.flow_stress;
        }
        return part;
      });
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

std::optional<Bend> bend_within(const Run& run, double dt, double length, double shortest) {
  constexpr double early = 0.1;       // of the run: later ones are compared with its work so far
  constexpr double short_share = 0.1; // of the longest by default: no shorter for that
  constexpr double most = 1e-3;       // of the work of a stage that goes on like this
  constexpr double much = 0.25; // of the flow stress: the force of contact that grows is little yet
  constexpr double nothing = 0.01; // of the work of the increment: what was done before
  const double flown = run.state.flights.flown; // nothing happens there
  if (run.state.time - flown >= early * (run.scene.stages.back().end - flown) ||
      dt <= short_share * default_longest(length))
    return std::nullopt;
  const EnergyBalance after = energy_after(run, dt);
  const double missed = after.missing() - run.state.energy.missing();
  const double work = after.largest_since(run.state.energy);
  const double expected = std::max(run.state.works.most, work * length / dt);
  if (std::abs(missed) <= std::max(most * expected, work_of_rounding(run)) ||
      average_effort(*run.model.bulk) < much)
    return std::nullopt;
  constexpr double half = 0.5;
  const double trapezoid = after.external - run.state.energy.external;
  const double share = run.state.works.most < nothing * work
                           ? bend_from_nothing(trapezoid, trapezoid - missed)
                           : half;
  if (std::min(share, 1.0 - share) * dt < shortest)
    return std::nullopt;
  return Bend{share, fmt::format("at this rate the balance of energy would miss {:.2g} % of the "
                                 "stage: solved in two parts",
                                 100.0 * std::abs(missed) / expected)};
}

} // namespace billet::process
