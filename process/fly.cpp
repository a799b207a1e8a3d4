// How the run loop goes through a flight. (P.31)

#include "process/increment_control.h"
#include "process/run.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

bool Process::flies(const Stage& stage, double length) {
  constexpr double least = 0.1; // of the stage: a shorter way costs little
  if (state_.flights.now && state_.time < state_.flights.now->until &&
      state_.flights.mesh == state_.record.remeshings.size())
    return true;
  state_.flights.now.reset();
  // Metal that follows its rate flows on under the stresses that are left in it.
  const bool relaxes = mechanics::follows_rate(scene_.material.flow) &&
                       state_.energy.elastic > state_.energy.nothing;
  const bool releases = contact_ && [&] {
    for (std::size_t t = 0; t < scene_.tools.size(); ++t)
      if (contact::leaves(*contact_, t, state_.time + least * length))
        return true;
    return false;
  }();
  if (releases || state_.time < state_.flights.none_before || stage.unload ||
      state_.time < state_.leaving.fading_until || !retreating_.empty() ||
      (blows_ && blows_->under_way()) || relaxes)
    return false;
  state_.flights.now = flight_from({scene_, stage, contact_.get(), surface_.get(), state_.x,
                                    state_.last_step, state_.time, state_.last_dt},
                                   least * length);
  state_.flights.mesh = state_.record.remeshings.size();
  return state_.flights.now.has_value();
}

namespace {

double longest_component(std::span<const double> v) {
  double most = 0.0;
  for (const double value : v)
    most = std::max(most, std::abs(value));
  return most;
}

} // namespace

/// The part goes along with its carrier: the first guess (P.2), and what contact predicts.
void Process::guess_flight(const Vec3& shift, double dt) {
  const int dim = scene_.mesh.dimension();
  state_.last_step.assign(state_.x.size(), 0.0);
  for (std::size_t i = 0; i < state_.origins.size(); ++i) {
    state_.last_step[i] = shift[static_cast<Index>(i) % dim];
    state_.velocity[i] = state_.last_step[i] / dt;
  }
  state_.last_dt = dt;
  trial_x_ = state_.x;
  for (std::size_t i = 0; i < state_.x.size(); ++i)
    trial_x_[i] += state_.last_step[i];
  const mechanics::Prescribed supports = prescribed(state_.time + dt);
  for (std::size_t k = 0; k < supports.unknowns.size(); ++k)
    trial_x_[idx(supports.unknowns[k])] = supports.positions[k]; // to the bit
}

bool Process::try_flight(double dt, std::string& why) {
  const Vec3 shift = state_.flights.now->carrier.shift(state_.time, state_.time + dt);
  if (contact_)
    contact_->restart();
  if (stabilization_ && !shift.isZero(0.0)) {
    // It resists as before the flight, or not at all: a long way is no load.
    constexpr double nothing = 1e-6; // of the body
    const double before = longest_component(state_.last_step);
    const double usual = before > 0.0 ? before : nothing * body_size(scene_.mesh);
    stabilization_->set_share(std::min(1.0, usual / shift.norm()) * stabilization_->share());
  }
  const std::vector<double> step = state_.last_step, velocity = state_.velocity;
  const double step_dt = state_.last_dt;
  guess_flight(shift, dt);
  if (contact_)
    contact_->predict(trial_x_);
  newton_->set_force_floor(force_floor(state_.time + dt));
  const auto outcome = newton_->solve(terms_, prescribed(state_.time + dt), state_.time,
                                      state_.time + dt, state_.x, trial_x_);
  if (outcome && limit_penetration(dt, why) && !turns_inside_out(why)) {
    state_.counters.last_residual = outcome->residual;
    state_.counters.last_iterations = spent();
    return true;
  }
  if (!outcome)
    why = outcome.error().reason;
  state_.counters.wasted_iterations += spent();
  state_.last_step = step;
  state_.velocity = velocity;
  state_.last_dt = step_dt;
  return false;
}

bool Process::fly(const Stage& stage, const std::vector<Observer*>& observers) {
  const double end = std::min(next_landing(stage.end), state_.flights.now->until);
  const double left = end - state_.time;
  const double step = step_towards(left, scene_.increments.max.value_or(left));
  const double share = stabilization_ ? stabilization_->share() : 1.0;
  std::string why;
  const bool solved = try_flight(step, why);
  if (solved) {
    accept(step);
    if (step == left)
      state_.time = end;
    state_.flights.flown += step;
  } else {
    ++state_.counters.cutbacks;
    state_.flights.none_before = state_.flights.now->until;
    state_.flights.now.reset();
  }
  if (stabilization_)
    stabilization_->set_share(share);
  if (solved)
    notify(observers, report(step, 0));
  return solved && state_.time == state_.flights.now->until;
}

} // namespace billet::process
