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
  if (flight_ && time_ < flight_->until && flight_mesh_ == remeshings_.size())
    return true;
  flight_.reset();
  // Metal that follows its rate flows on under the stresses that are left in it.
  const bool relaxes =
      mechanics::follows_rate(scene_.material.flow) && energy_.elastic > energy_.nothing;
  const bool releases = contact_ && [&] {
    for (std::size_t t = 0; t < scene_.tools.size(); ++t)
      if (contact_->leaves(t, time_ + least * length))
        return true;
    return false;
  }();
  if (releases || time_ < no_flight_before_ || stage.unload || time_ < fading_until_ ||
      !retreating_.empty() || (blows_ && blows_->under_way()) || relaxes)
    return false;
  flight_ =
      flight_from({scene_, stage, contact_.get(), surface_.get(), x_, last_step_, time_, last_dt_},
                  least * length);
  flight_mesh_ = remeshings_.size();
  return flight_.has_value();
}

namespace {

double longest_component(std::span<const double> v) {
  double most = 0.0;
  for (const double value : v)
    most = std::max(most, std::abs(value));
  return most;
}

} // namespace

/// The part goes along with its carrier: the first guess (P.2), and what contact foretells.
void Process::guess_flight(const Vec3& shift, double dt) {
  const int dim = scene_.mesh.dimension();
  last_step_.assign(x_.size(), 0.0);
  for (std::size_t i = 0; i < x0_.size(); ++i) {
    last_step_[i] = shift[static_cast<Index>(i) % dim];
    velocity_[i] = last_step_[i] / dt;
  }
  last_dt_ = dt;
  trial_x_ = x_;
  for (std::size_t i = 0; i < x_.size(); ++i)
    trial_x_[i] += last_step_[i];
  const mechanics::Prescribed supports = prescribed(time_ + dt);
  for (std::size_t k = 0; k < supports.unknowns.size(); ++k)
    trial_x_[idx(supports.unknowns[k])] = supports.positions[k]; // to the bit
}

bool Process::try_flight(double dt, std::string& why) {
  const Vec3 shift = flight_->carrier.shift(time_, time_ + dt);
  if (contact_)
    contact_->restart();
  if (grounding_ && !shift.isZero(0.0)) {
    // It resists as before the flight, or not at all: a long way is no load.
    constexpr double nothing = 1e-6; // of the body
    const double before = longest_component(last_step_);
    const double usual = before > 0.0 ? before : nothing * body_size(scene_.mesh);
    grounding_->set_share(std::min(1.0, usual / shift.norm()) * grounding_->share());
  }
  const std::vector<double> step = last_step_, velocity = velocity_;
  const double step_dt = last_dt_;
  guess_flight(shift, dt);
  if (contact_)
    contact_->foretell(trial_x_);
  newton_->set_force_floor(force_floor(time_ + dt));
  const auto outcome =
      newton_->solve(terms_, prescribed(time_ + dt), time_, time_ + dt, x_, trial_x_);
  if (outcome && limit_penetration(dt, why) && !turns_inside_out(why)) {
    last_residual_ = outcome->residual;
    last_iterations_ = spent();
    return true;
  }
  if (!outcome)
    why = outcome.error().reason;
  wasted_iterations_ += spent();
  last_step_ = step;
  velocity_ = velocity;
  last_dt_ = step_dt;
  return false;
}

bool Process::fly(const Stage& stage, const std::vector<Observer*>& observers) {
  const double end = std::min(next_landing(stage.end), flight_->until);
  const double left = end - time_;
  const double step = step_towards(left, scene_.increments.max.value_or(left));
  const double share = grounding_ ? grounding_->share() : 1.0;
  std::string why;
  const bool solved = try_flight(step, why);
  if (solved) {
    accept(step);
    if (step == left)
      time_ = end;
    flown_ += step;
  } else {
    ++cutbacks_;
    no_flight_before_ = flight_->until;
    flight_.reset();
  }
  if (grounding_)
    grounding_->set_share(share);
  if (solved)
    notify(observers, report(step, 0));
  return solved && time_ == flight_->until;
}

} // namespace billet::process
