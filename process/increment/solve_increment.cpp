#include "process/increment/solve_increment.h"

#include "geometry/base/outcome.h"
#include "process/increment/acceptance.h"
#include "process/increment/force_floor.h"
#include "process/increment/stabilization_control.h"
#include "process/stages/unloading.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

namespace billet::process {

namespace {

/// Whether the part lies on any tool.
bool touched(const Run& run) {
  if (run.model.contact)
    for (std::size_t t = 0; t < run.tools().size(); ++t)
      if (contact::lies_on(*run.model.contact, t))
        return true;
  return false;
}

/// Which contact points kept changing in the last try, for the log; empty: none.
std::string chattering_points(Run& run) {
  if (!run.model.contact)
    return {};
  const std::vector<contact::ChatteringPoint> points = contact::chattering(*run.model.contact);
  if (points.empty())
    return {};
  run.attempt.chattering = points;
  const auto& worst = points.front();
  return fmt::format("; {} contact point(s) kept changing between open, stick and slip, most of "
                     "all one on tool '{}' at ({:.6g}, {:.6g}, {:.6g}): {} times",
                     points.size(), run.tools()[worst.tool].name, worst.position[0],
                     worst.position[1], worst.position[2], worst.changes);
}

/// The first guess: on as in the last increment, or where everything is.
void guess(Run& run, double dt, mechanics::Continuation continuation) {
  run.attempt.x = run.state.x;
  if (run.state.last_step.empty() || continuation == mechanics::Continuation::penalty_and_friction)
    return;
  const double factor = dt / run.state.last_dt;
  for (std::size_t i = 0; i < run.state.x.size(); ++i)
    run.attempt.x[i] += factor * run.state.last_step[i];
}

/// Equilibrium from the first guess on, and whether it can be accepted.
Outcome<Done> solve_and_check(Run& run, double dt, mechanics::Continuation continuation) {
  if (run.model.contact)
    run.model.contact->predict(predicted(run, dt));
  run.model.newton->set_force_floor(force_floor(run, run.state.time + dt));
  draw_back_to(run, run.state.time + dt);
  auto outcome =
      run.model.newton->solve(run.model.terms, prescribed(run, run.state.time + dt), run.state.time,
                              run.state.time + dt, run.state.x, run.attempt.x, continuation);
  if (outcome && run.model.stabilization)
    outcome = with_light_stabilization(run, dt, *outcome);
  if (!outcome) {
    run.attempt.inside_out = run.attempt.moves_away = false;
    return Failure{outcome.error().reason + chattering_points(run)};
  }
  run.attempt.residual = outcome->residual;
  return check_solution(run, dt, outcome->force_scale);
}

} // namespace

int spent(const Run& run) {
  return static_cast<int>(run.solver_work().systems - run.attempt.systems_before);
}

Outcome<Done> solve_increment(Run& run, double dt, mechanics::Continuation continuation) {
  run.attempt.none = false;
  run.attempt.systems_before = run.solver_work().systems;
  guess(run, dt, continuation);
  if (Outcome<Done> outside = check_passages(run, dt); !outside)
    return outside;
  Outcome<Done> solved = solve_and_check(run, dt, continuation);
  if (solved)
    run.attempt.iterations = spent(run);
  else
    run.state.counters.wasted_iterations += spent(run);
  return solved;
}

Outcome<Done> try_increment(Run& run, double dt, mechanics::Continuation continuation) {
  if (run.model.contact)
    run.model.contact->restart();
  Outcome<Done> solved = solve_increment(run, dt, continuation);
  if (solved || !run.model.stabilization)
    return solved;
  const auto solved_with = [&](double share) {
    run.model.stabilization->set_share(share);
    if (run.model.contact)
      run.model.contact->restart();
    solved = solve_increment(run, dt, continuation);
    return solved.has_value();
  };
  const double share = run.model.stabilization->share();
  if (share != 1.0 && solved_with(1.0)) // what held the part so far may have gone
    return solved;
  // Forces that fade keep their directions: a bent sheet between them may be about to turn over.
  if (run.state.time < run.state.leaving.decay_until && !touched(run))
    for (const double stiffer : {10.0, 100.0, 1e3})
      if (stiffer > share && solved_with(stiffer))
        return solved;
  run.model.stabilization->set_share(1.0);
  return solved;
}

} // namespace billet::process
