#include "process/increment/force_floor.h"

#include "process/scene/scene.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <algorithm>
#include <cmath>

namespace billet::process {

namespace {

/// The largest force that has acted so far or acts now; on a slender body the floor is relative to
/// it, not to the body's own stiffness. (N.2)
double acting_force(const Run& run, double time) {
  double acting = run.state.forces.largest;
  for (const auto& load : run.model.loads)
    acting = std::max(acting, load->norm(time, run.state.x));
  return acting;
}

} // namespace

double force_floor(const Run& run, double time) {
  constexpr double none = 1e-7, least = 1e-10; // of the stiffness times the size
  constexpr double times_acting = 1e3;
  const double acting = acting_force(run, time);
  const double body = body_stiffness(run.scene, run.part()) * body_size(run.mesh());
  constexpr double of_a_touch = 1e-6; // of the same
  if (run.attempt.hardly_touches)
    return of_a_touch * body;
  return acting > 0.0 ? std::clamp(times_acting * acting, least * body, none * body) : none * body;
}

bool may_hardly_touch(const Run& run, double time) {
  constexpr double hardly = 1e-11; // of the stiffness times the size
  return acting_force(run, time) <
         hardly * body_stiffness(run.scene, run.part()) * body_size(run.mesh());
}

void note_largest_force(Run& run, double of_stabilization) {
  // A part that is pushed through the air is held back by its stabilization alone.
  constexpr double far_above = 100.0; // a sum over nodes against a norm
  const auto note = [&](double force) {
    if (force > far_above * of_stabilization)
      run.state.forces.largest = std::max(run.state.forces.largest, force);
  };
  for (const Index i : prescribed_by_supports(run, run.state.time).unknowns)
    note(std::abs(run.state.reactions[idx(i)]));
  if (run.model.contact)
    for (const contact::ToolLoad& load : run.model.contact->loads())
      note(load.force.norm());
}

} // namespace billet::process
