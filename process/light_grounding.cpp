// What lets a slender body be solved for: forces that count as none, and a stabilization that is no
// stiffer than the body. (M.17), (N.2)

#include "process/remeshing.h"
#include "process/run.h"

#include <algorithm>
#include <cmath>

namespace billet::process {

/// Forces that count as none beside the body's own stiffness, or beside those that have acted so
/// far on a slender body. (N.2)
double Process::acting_force(double time) const {
  double acting = state_.forces.largest;
  for (const auto& load : loads_)
    acting = std::max(acting, load->norm(time, state_.x));
  return acting;
}

double Process::force_floor(double time) const {
  constexpr double none = 1e-7, least = 1e-10; // of the stiffness times the size
  constexpr double times_acting = 1e3;
  const double acting = acting_force(time);
  const double body = body_stiffness() * body_size(scene_.mesh);
  constexpr double of_a_touch = 1e-6; // likewise
  if (hardly_touches_)
    return of_a_touch * body;
  return acting > 0.0 ? std::clamp(times_acting * acting, least * body, none * body) : none * body;
}

bool Process::may_hardly_touch(double time) const {
  constexpr double hardly = 1e-11; // of the stiffness times the size
  return acting_force(time) < hardly * body_stiffness() * body_size(scene_.mesh);
}

void Process::note_largest_force(double of_stabilization) {
  // A part that is pushed through the air is held back by its stabilization alone.
  constexpr double far_above = 100.0; // a sum over nodes against a norm
  const auto note = [&](double force) {
    if (force > far_above * of_stabilization)
      state_.forces.largest = std::max(state_.forces.largest, force);
  };
  for (const Index i : prescribed(state_.time).unknowns)
    note(std::abs(state_.reactions[idx(i)]));
  if (contact_)
    for (const contact::ToolLoad& load : contact_->loads())
      note(load.force.norm());
}

bool Process::stabilization_weighs(double dt) const {
  constexpr double nothing = 1e-6; // of all work so far
  constexpr double little = 1e-3;  // of the work of the increment
  const double lost = stabilization_->work_in({state_.time, state_.time + dt, state_.x, trial_x_});
  if (lost <= nothing * state_.works.most)
    return false;
  const EnergyBalance after = energy_after(dt);
  constexpr double rigid = 1e-6; // of what is lost: the part is pushed through the air
  if (std::max({std::abs(after.elastic - state_.energy.elastic),
                after.plastic - state_.energy.plastic, after.friction - state_.energy.friction}) <=
      rigid * lost)
    return false;
  return lost > little * after.largest_since(state_.energy);
}

/// A slender part is softer than the stabilization, which would carry the load of its tools: where
/// it does it is made lighter, as far as the part is held by something else. (M.17)
Outcome<mechanics::NewtonReport>
Process::with_light_stabilization(double dt, const mechanics::NewtonReport& solved) {
  constexpr double lightest = 1e-6; // equations are solved in double precision
  constexpr int longest_wait = 3;
  const auto solve_on = [&] {
    return newton_->solve(terms_, prescribed(state_.time + dt), state_.time, state_.time + dt,
                          state_.x, trial_x_, mechanics::Continuation::from_solution);
  };
  Outcome<mechanics::NewtonReport> now = solved;
  if (state_.stabilization.wait > 0 && state_.stabilization.wait-- > 0)
    return now;
  // What was held by the stabilization so far may have a long way to go at once.
  for (const double lighter : {1e-2, 0.3})
    while (stabilization_->share() > lightest && stabilization_weighs(dt)) {
      const std::vector<double> x = trial_x_;
      const double share = stabilization_->share();
      stabilization_->set_share(std::max(lightest, lighter * share));
      const auto again = solve_on();
      if (again) {
        now = again;
        state_.stabilization.failures = 0;
        continue;
      }
      stabilization_->set_share(share);
      trial_x_ = x;
      now = solve_on();
      if (!now)
        return now;
      state_.stabilization.wait = std::min(++state_.stabilization.failures / 2, longest_wait);
      break;
    }
  return now;
}

} // namespace billet::process
