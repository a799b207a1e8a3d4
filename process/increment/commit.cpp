#include "process/increment/commit.h"

#include "process/energy/balance.h"
#include "process/increment/force_floor.h"
#include "process/increment/penetration_limit.h"
#include "process/increment/snapshots.h"
#include "process/increment/symmetry_walls.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Where the normal force lay in the increment just accepted.
void note_touches(Run& run, double dt) {
  const std::span<const std::vector<contact::ClosedPoint>> closed = run.model.contact->closed();
  for (std::size_t t = 0; t < closed.size(); ++t)
    for (const contact::ClosedPoint& point : closed[t]) {
      const double impulse = point.pressure * point.area * dt;
      run.state.record.touches[t].impulse += impulse;
      if (point.touching == 0.0)
        run.state.record.touches[t].unexpected += impulse;
    }
}

/// Takes the increment just accepted into the sums over contact.
void account_contact(Run& run, double dt) {
  if (!run.model.contact)
    return;
  std::vector<double> strain;
  strain.reserve(run.model.bulk->states().size());
  for (const auto& state : run.model.bulk->states())
    strain.push_back(state.plastic_strain);
  run.state.record.window.add(run.model.contact->closed(),
                              {run.model.surface->bulk_points(), strain, run.state.plastic_rate},
                              dt);
  note_touches(run, dt);
  if (run.model.wear)
    run.model.wear->add(*run.model.contact, run.state.x, run.state.time);
}

} // namespace

void commit(Run& run, double dt) {
  const mechanics::Trial trial = run.trial(dt);
  std::vector<double> strain_old(run.model.bulk->states().size());
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    strain_old[k] = run.model.bulk->states()[k].plastic_strain;
  for (mechanics::ForceTerm* term : run.model.terms)
    term->commit(trial);
  run.state.record.events =
      run.model.blows ? run.model.blows->commit(trial) : std::vector<std::string>();
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    run.state.plastic_rate[k] = (run.model.bulk->states()[k].plastic_strain - strain_old[k]) / dt;
  run.state.works.supports += work_of_supports(run, dt);
  double of_stabilization = 0.0;
  if (run.model.stabilization) {
    run.state.energy.stabilization += run.model.stabilization->work_in(trial);
    of_stabilization = run.model.stabilization->force_in(trial);
  }
  for (const Index i : prescribed_by_supports(run, run.state.time + dt).unknowns)
    run.state.reactions[idx(i)] = run.model.newton->residual()[idx(i)];
  run.state.last_step.resize(run.state.x.size());
  for (std::size_t i = 0; i < run.state.x.size(); ++i) {
    run.state.last_step[i] = run.attempt.x[i] - run.state.x[i];
    if (i < run.state.velocity.size())
      run.state.velocity[i] = run.state.last_step[i] / dt;
  }
  run.state.last_dt = dt;
  run.state.x = run.attempt.x;
  run.state.time += dt;
  note_largest_force(run, of_stabilization);
  if (std::exchange(run.attempt.friction_lagged, false))
    ++run.state.counters.friction_lagged;
}

void accept(Run& run, double dt) {
  if (run.scene.remesh) {
    take_snapshot(run);
    note_forces(run);
  }
  const bool fades = run.state.time < run.state.leaving.decay_until;
  run.attempt.chattering.clear();
  commit(run, dt);
  if (!run.state.record.refusal_event.empty())
    run.state.record.events.push_back(std::exchange(run.state.record.refusal_event, {}));
  if (!run.state.record.penalty_event.empty())
    run.state.record.events.push_back(std::exchange(run.state.record.penalty_event, {}));
  for (std::string& line : hold_on_walls(run))
    run.state.record.events.push_back(std::move(line));
  ++run.state.increment;
  run.state.counters.iterations += run.attempt.iterations;
  if (run.state.increment == run.state.mesh.increment + 1)
    run.state.mesh.share = run.attempt.penetration.share;
  note_deepest_tool(run);
  const double external = run.state.energy.external;
  const double plastic = run.state.energy.plastic;
  update_energy(run);
  if (fades && contact::bearing_area(*run.model.contact) == 0.0)
    run.state.leaving.flow_in_decay += run.state.energy.plastic - plastic;
  run.state.springs_back = run.state.energy.external < external;
  account_contact(run, dt);
  run.attempt.none = true;
}

} // namespace billet::process
