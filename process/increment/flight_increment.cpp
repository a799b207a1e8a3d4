#include "process/increment/flight_increment.h"

#include "process/control/increment_control.h"
#include "process/increment/acceptance.h"
#include "process/increment/commit.h"
#include "process/increment/force_floor.h"
#include "process/increment/increment_report.h"
#include "process/increment/penetration_limit.h"
#include "process/increment/solve_increment.h"
#include "process/reports/observer.h"
#include "process/scene/scene.h"
#include "process/stages/stage_start.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"
#include "process/tools/flight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::process {

namespace {

double longest_component(std::span<const double> v) {
  double most = 0.0;
  for (const double value : v)
    most = std::max(most, std::abs(value));
  return most;
}

/// The part goes along with its carrier: the first guess (P.2), and what contact predicts.
void guess_flight(Run& run, const Vec3& shift, double dt) {
  const int dim = run.mesh().dimension();
  run.state.last_step.assign(run.state.x.size(), 0.0);
  for (std::size_t i = 0; i < run.n_nodal(); ++i) {
    run.state.last_step[i] = shift[static_cast<Index>(i) % dim];
    run.state.velocity[i] = run.state.last_step[i] / dt;
  }
  run.state.last_dt = dt;
  run.attempt.x = run.state.x;
  for (std::size_t i = 0; i < run.state.x.size(); ++i)
    run.attempt.x[i] += run.state.last_step[i];
  const mechanics::Prescribed supports = prescribed(run, run.state.time + dt);
  for (std::size_t k = 0; k < supports.unknowns.size(); ++k)
    run.attempt.x[idx(supports.unknowns[k])] = supports.positions[k]; // to the bit
}

/// Attempts an increment of the flight.
bool try_flight(Run& run, double dt) {
  run.attempt.friction_lagged = false;
  run.attempt.systems_before = run.solver_work().systems;
  const Vec3 shift = run.state.flights.now->carrier.shift(run.state.time, run.state.time + dt);
  if (run.model.contact)
    run.model.contact->restart();
  if (run.model.stabilization && !shift.isZero(0.0)) {
    // It resists as before the flight, or not at all: a long way is no load.
    constexpr double nothing = 1e-6; // of the body
    const double before = longest_component(run.state.last_step);
    const double usual = before > 0.0 ? before : nothing * body_size(run.mesh());
    run.model.stabilization->set_share(std::min(1.0, usual / shift.norm()) *
                                       run.model.stabilization->share());
  }
  const std::vector<double> step = run.state.last_step, velocity = run.state.velocity;
  const double step_dt = run.state.last_dt;
  guess_flight(run, shift, dt);
  if (run.model.contact)
    run.model.contact->predict(run.attempt.x);
  run.model.newton->set_force_floor(force_floor(run, run.state.time + dt));
  const auto outcome =
      run.model.newton->solve(run.model.terms, prescribed(run, run.state.time + dt), run.state.time,
                              run.state.time + dt, run.state.x, run.attempt.x);
  if (outcome && limit_penetration(run, dt) && check_shape(run)) {
    run.attempt.residual = outcome->residual;
    run.attempt.iterations = spent(run);
    return true;
  }
  run.state.counters.wasted_iterations += spent(run);
  run.state.last_step = step;
  run.state.velocity = velocity;
  run.state.last_dt = step_dt;
  return false;
}

} // namespace

bool flies(Run& run, const Stage& stage, double length) {
  constexpr double least = 0.1; // of the stage: a shorter way costs little
  if (run.state.flights.now && run.state.time < run.state.flights.now->until &&
      run.state.flights.mesh == run.state.record.remeshings.size())
    return true;
  run.state.flights.now.reset();
  // Metal that follows its rate flows on under the stresses that are left in it.
  const bool relaxes = mechanics::follows_rate(run.scene.material.flow) &&
                       run.state.energy.elastic > run.state.energy.nothing;
  const bool releases = run.model.contact && [&] {
    for (std::size_t t = 0; t < run.tools().size(); ++t)
      if (contact::leaves(*run.model.contact, t, run.state.time + least * length))
        return true;
    return false;
  }();
  if (releases || run.state.time < run.state.flights.none_before || stage.unload ||
      run.state.time < run.state.leaving.decay_until || !run.model.retreating.empty() ||
      (run.model.blows && run.model.blows->under_way()) || relaxes)
    return false;
  run.state.flights.now =
      flight_from({run.part(), run.tools(), stage, run.model.contact.get(), run.model.surface.get(),
                   run.state.x, run.state.last_step, run.state.time, run.state.last_dt},
                  least * length);
  run.state.flights.mesh = run.state.record.remeshings.size();
  return run.state.flights.now.has_value();
}

bool fly(Run& run, const Stage& stage, const std::vector<Observer*>& observers) {
  const double end = std::min(next_landing(run, stage.end), run.state.flights.now->until);
  const double left = end - run.state.time;
  const double step = step_towards(left, run.scene.increments.max.value_or(left));
  const double share = run.model.stabilization ? run.model.stabilization->share() : 1.0;
  const bool solved = try_flight(run, step);
  if (solved) {
    accept(run, step);
    if (step == left)
      run.state.time = end;
    run.state.flights.flown += step;
  } else {
    ++run.state.counters.cutbacks;
    run.state.flights.none_before = run.state.flights.now->until;
    run.state.flights.now.reset();
  }
  if (run.model.stabilization)
    run.model.stabilization->set_share(share);
  if (solved)
    notify(run, observers, report(run, step, 0));
  return solved && run.state.time == run.state.flights.now->until;
}

} // namespace billet::process
