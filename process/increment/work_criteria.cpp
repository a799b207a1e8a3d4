#include "process/increment/work_criteria.h"

#include "process/energy/balance.h"
#include "process/reports/energy_balance.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace billet::process {

std::optional<std::string> misses_too_much(const Run& run, double dt, double length) {
  constexpr double rounding = 1e-9;
  constexpr double most = 0.05;        // of the work of an increment longer than by default
  constexpr double most_of_all = 1e-3; // of all work so far, in one of another length
  constexpr double early = 0.1;        // of the run: there is next to no work yet to compare with
  constexpr double short_share = 0.1;  // of the longest: no shorter for that
  const double usual = default_longest(length);
  const bool is_long = dt > (1.0 + rounding) * usual;
  const bool is_spoiling = !run.scene.increments.max && dt > short_share * usual &&
                           run.state.time - run.state.flights.flown >
                               early * (run.scene.stages.back().end - run.state.flights.flown);
  if (!is_long && !is_spoiling)
    return std::nullopt;
  const EnergyBalance after = energy_after(run, dt);
  const double missed = std::abs(after.missing() - run.state.energy.missing());
  if (missed <= work_of_rounding(run))
    return std::nullopt;
  if (is_long && after.error_since(run.state.energy) > most)
    return fmt::format("its balance of energy misses {:.2g} %",
                       100.0 * after.error_since(run.state.energy));
  if (!is_long && missed > most_of_all * run.state.works.most)
    return fmt::format("its balance of energy misses {:.2g} % of all work so far",
                       100.0 * missed / run.state.works.most);
  return std::nullopt;
}

double missed_since(const Run& run, const EnergyBalance& before, double gone) {
  constexpr double half_of_the_budget = 0.0025; // the balance of a run is to be within 0.5 %
  constexpr double early = 0.1;                 // what the first yield misses counts little later
  const double used = run.state.energy.error() / half_of_the_budget;
  const bool at_risk = gone > early && used > 1.0;
  // The less of the budget is left the more is asked of an increment.
  return at_risk && !run.scene.increments.max ? used * used * run.state.energy.error_since(before)
                                              : 0.0;
}

bool lets_go_too_fast(const Run& run, double dt) {
  constexpr double early = 0.1; // of the run: there is next to no work yet to compare with
  if (!run.model.contact || run.scene.increments.max ||
      run.state.time - run.state.flights.flown <
          early * (run.scene.stages.back().end - run.state.flights.flown))
    return false;
  // Of all work so far, for a tool whose force falls by more than half.
  constexpr double most = 1e-3, fall = 0.5;
  const mechanics::Trial trial = run.trial(dt);
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    if (!run.model.contact->acts(t, run.state.time + dt))
      continue;
    const auto [before, now] = contact::forces_of_tool(*run.model.contact, t, trial);
    if (now.sum < fall * before.sum &&
        0.5 * std::abs(now.work - before.work) >
            std::max(most * run.state.works.most, work_of_rounding(run)))
      return true;
  }
  return false;
}

} // namespace billet::process
