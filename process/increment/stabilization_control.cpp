#include "process/increment/stabilization_control.h"

#include "geometry/base/outcome.h"
#include "process/energy/balance.h"
#include "process/reports/energy_balance.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace billet::process {

namespace {

/// Whether the stabilization takes more of the increment just tried than it may.
bool stabilization_weighs(const Run& run, double dt) {
  constexpr double nothing = 1e-6; // of all work so far
  constexpr double little = 1e-3;  // of the work of the increment
  const double lost = run.model.stabilization->work_in(run.trial(dt));
  if (lost <= nothing * run.state.works.most)
    return false;
  const EnergyBalance after = energy_after(run, dt);
  constexpr double rigid = 1e-6; // of what is lost: the part is pushed through the air
  if (std::max({std::abs(after.elastic - run.state.energy.elastic),
                after.plastic - run.state.energy.plastic,
                after.friction - run.state.energy.friction}) <= rigid * lost)
    return false;
  return lost > little * after.largest_since(run.state.energy);
}

} // namespace

/// A slender part is softer than the stabilization, which would carry the load of its tools: where
/// it does it is made lighter, as far as the part is held by something else. (M.17)
Outcome<mechanics::NewtonReport>
with_light_stabilization(Run& run, double dt, const mechanics::NewtonReport& solved) {
  constexpr double lightest = 1e-6; // equations are solved in double precision
  constexpr int longest_wait = 3;
  const auto solve_on = [&] {
    return run.model.newton->solve(run.model.terms, prescribed(run, run.state.time + dt),
                                   run.state.time, run.state.time + dt, run.state.x, run.attempt.x,
                                   mechanics::Continuation::from_solution);
  };
  Outcome<mechanics::NewtonReport> now = solved;
  if (run.state.stabilization.wait > 0 && run.state.stabilization.wait-- > 0)
    return now;
  // What was held by the stabilization so far may have a long way to go at once.
  for (const double lighter : {1e-2, 0.3})
    while (run.model.stabilization->share() > lightest && stabilization_weighs(run, dt)) {
      const std::vector<double> x = run.attempt.x;
      const double share = run.model.stabilization->share();
      run.model.stabilization->set_share(std::max(lightest, lighter * share));
      const auto again = solve_on();
      if (again) {
        now = again;
        run.state.stabilization.failures = 0;
        continue;
      }
      run.model.stabilization->set_share(share);
      run.attempt.x = x;
      now = solve_on();
      if (!now)
        return now;
      run.state.stabilization.wait = std::min(++run.state.stabilization.failures / 2, longest_wait);
      break;
    }
  return now;
}

} // namespace billet::process
