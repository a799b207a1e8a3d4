#include "process/increment/snapshots.h"

#include "process/state/run.h"
#include "process/state/state.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::process {

namespace {

/// Elastic energy of shape of the points that flow [N mm].
double flowing_energy(const Run& run) {
  const std::vector<double> shape = run.model.bulk->shape_energies();
  double energy = 0.0;
  for (std::size_t k = 0; k < shape.size(); ++k)
    if (run.state.plastic_rate[k] > 0.0)
      energy += shape[k];
  return energy;
}

} // namespace

std::vector<double> forces_on_tools(const Run& run) {
  std::vector<double> forces;
  if (run.model.contact)
    for (const contact::ToolLoad& load : run.model.contact->loads())
      forces.push_back(load.force.norm());
  return forces;
}

void note_forces(Run& run) {
  run.state.forces.before = forces_on_tools(run);
  run.state.forces.largest_on_tools.resize(run.state.forces.before.size(), 0.0);
  for (std::size_t t = 0; t < run.state.forces.before.size(); ++t)
    run.state.forces.largest_on_tools[t] =
        run.state.forces.before[t] > 0.0
            ? std::max(run.state.forces.largest_on_tools[t], run.state.forces.before[t])
            : 0.0;
}

Snapshot snapshot(const Run& run) {
  Snapshot s;
  s.time = run.state.time;
  s.increment = run.state.increment;
  s.x = run.state.x;
  s.states.assign(run.model.bulk->states().begin(), run.model.bulk->states().end());
  s.temperatures.assign(run.model.bulk->temperatures().begin(),
                        run.model.bulk->temperatures().end());
  s.velocity = run.state.velocity;
  s.last_step = run.state.last_step;
  s.last_dt = run.state.last_dt;
  s.plastic_rate = run.state.plastic_rate;
  if (run.model.contact)
    s.contact = contact::snapshot(run.model.contact->state());
  if (run.model.self_contact)
    s.self_contact = run.model.self_contact->snapshot(run.state.x);
  if (run.model.trapped)
    s.trapped = run.model.trapped->snapshot();
  s.reference_volume = run.model.bulk->reference_volume();
  s.plastic_work = run.model.bulk->plastic_work();
  s.support_work = run.state.works.supports;
  s.load_work = run.state.works.loads_before;
  for (const auto& load : run.model.loads)
    s.load_work += load->work();
  for (const auto& load : run.model.decaying)
    s.load_work += load->work();
  s.stabilization = run.state.energy.stabilization;
  return s;
}

void take_snapshot(Run& run) {
  if (run.state.time < run.state.leaving.decay_until)
    return; // a new mesh does not know the forces of tools that have left
  // What the transfer has left too low is back where it was after that much flow.
  const bool in_space = run.mesh().dimension() == 3;
  const double flow = in_space ? 64.0 : 16.0;      // plastic work over (P.20)'s elastic energy
  const int most_increments = in_space ? 120 : 40; // where little flows nothing is too low
  constexpr int parts = 3;                         // of the way: how closely its length is met
  const auto flowed_on = [&](const Snapshot& since) {
    return (run.state.increment - since.increment) * parts >= most_increments ||
           (run.model.bulk->plastic_work() - since.plastic_work) * parts >=
               flow * flowing_energy(run);
  };
  if (!run.state.snapshots.empty() && !flowed_on(run.state.snapshots.back()))
    return;
  run.state.snapshots.push_back(snapshot(run));
  if (run.state.snapshots.size() > parts + 1)
    run.state.snapshots.erase(run.state.snapshots.begin());
}

} // namespace billet::process
