// How contact keeps a limit of penetration: stiffer penalties, or multipliers; and what their
// changes do to the balance of energy. (C.20)-(C.24), (C.41), (C.43)

#include "contact/term/contact_term.h"

#include <algorithm>

namespace billet::contact {

Penalty ContactTerm::penalty() const {
  Penalty penalty = surface_->penalty();
  penalty.normal *= stiffening_ * softening_;
  // What presses lightly must not rather slip than sink: the share that the defaults have.
  constexpr double of_normal = 0.1;
  if (stiffening_ < 1.0)
    penalty.tangent = std::min(penalty.tangent, of_normal * penalty.normal);
  return penalty;
}

double ContactTerm::carried(const ToolState& state, std::size_t point) const {
  const double multiplier = state.multiplier[point];
  const PointHistory& history = state.history[point];
  const double pressed = history.closed() ? history.pressure - multiplier : 0.0;
  return multiplier + (1.0 - softening_) * pressed;
}

void ContactTerm::restart() {
  forget_predicted();
  stiffening_ = stiffening_next_;
  for (ToolState& state : states_) {
    std::fill(state.changes.begin(), state.changes.end(), 0);
    std::fill(state.friction_limited.begin(), state.friction_limited.end(), char{0});
    for (std::size_t k = 0; k < state.history.size(); ++k)
      state.multiplier[k] = state.history[k].multiplier;
    for (CornerContact::Corner& corner : state.corners.corners())
      corner.multiplier = corner.history.multiplier;
  }
}

bool ContactTerm::restart_friction_limited() {
  std::vector<std::vector<char>> limited;
  bool any = false;
  for (const ToolState& state : states_) {
    std::vector<char>& points = limited.emplace_back(state.friction_limited);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Traction& now = state.trial[k];
      if (points[k] != 0 || state.changes[k] < chattering_changes ||
          !(now.status == Status::open || now.limit > now.pressure))
        continue;
      points[k] = 1;
      any = true;
    }
  }
  restart();
  for (std::size_t t = 0; t < states_.size(); ++t)
    states_[t].friction_limited = std::move(limited[t]);
  return any;
}

void ContactTerm::augment() {
  for (ToolState& state : states_) {
    for (std::size_t k = 0; k < state.trial.size(); ++k)
      state.multiplier[k] = std::max(0.0, state.trial[k].pressure);
    for (CornerContact::Corner& corner : state.corners.corners())
      corner.multiplier = corner.trial.traction.pressure;
  }
}

double ContactTerm::stored(const Traction& now, double multiplier) const {
  return 0.5 * (now.pressure * now.pressure - multiplier * multiplier) / penalty().normal;
}

double ContactTerm::enforcement_work(const PointHistory& old,
                                     const Traction& now,
                                     double multiplier) const {
  const double K = penalty().normal;
  const double K_old = K * (stiffening_old_ / stiffening_);
  const double multiplier_old = old.closed() ? old.multiplier : 0.0;
  if (now.status == Status::open) // it has parted at the old multiplier, which then went
    return 0.5 * multiplier_old * multiplier_old / K_old;
  const double depth = (now.pressure - multiplier) / K;
  const double depth_old = old.closed() ? (old.pressure - old.multiplier) / K_old : 0.0;
  return 0.5 *
         ((multiplier - multiplier_old) * (depth + depth_old) + (K - K_old) * depth * depth_old);
}

double ContactTerm::pressed_shift(const PointHistory& old,
                                  const Traction& now,
                                  double multiplier,
                                  double shift) const {
  const bool closed = now.status != Status::open;
  if (old.closed() && closed)
    return shift;
  const double K = penalty().normal;
  const double depth = closed ? (now.pressure - multiplier) / K : 0.0;
  const double depth_old =
      old.closed() ? (old.pressure - old.multiplier) / (K * (stiffening_old_ / stiffening_)) : 0.0;
  return std::clamp(shift, -std::max(0.0, depth_old), std::max(0.0, depth));
}

} // namespace billet::contact
