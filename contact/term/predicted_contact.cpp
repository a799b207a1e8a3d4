// What is known of contact when an increment begins, if all goes on as in the last one: where
// points come to touch (C.42), and how tools turn against faces (C.5a).

#include "contact/term/contact_term.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace billet::contact {

void ContactTerm::predict(std::span<const double> x) {
  forget_predicted();
  predicted_.assign(x.begin(), x.end());
  surface_->positions(x, predicted_positions_);
}

void ContactTerm::forget_predicted() {
  predicted_.clear();
  for (ToolState& state : states_) {
    std::fill(state.touching.begin(), state.touching.end(), std::nullopt);
    state.turn.clear();
  }
}

double
ContactTerm::touching_share(std::size_t t, std::size_t point, const mechanics::Trial& trial) const {
  if (predicted_.empty())
    return 0.0;
  const ToolState& state = states_[t];
  const std::span<const double> drives =
      held_[t] != 0 || rests_[t] != 0 ? trial.x_old : std::span(predicted_);
  const std::array<Vec3, 2> places{
      state.history[point].position,
      pose(t, trial.time, drives).to_tool(predicted_positions_[point])};
  std::array<geometry::Projection, 2> feet;
  for (geometry::Projection& foot : feet)
    foot.patch = state.foot[point].patch;
  tools_[t].surface->project(places, reach_, feet);
  const double before = feet[0].gap + state.history[point].added();
  const double after = feet[1].gap + state.history[point].added();
  if (!feet[0].found() || !feet[1].found() || !(after < 0.0))
    return 0.0;
  return before > 0.0 ? after / (after - before) : 1.0;
}

bool ContactTerm::any_turns(const mechanics::Trial& trial) const {
  const auto angle = [&](std::size_t t, double time, std::span<const double> x) {
    return tools_[t].motion.angle(time, driven(t, x));
  };
  for (std::size_t t = 0; t < tools_.size(); ++t)
    if (acts(t, trial.time) &&
        angle(t, trial.time, trial.x) != angle(t, trial.time_old, trial.x_old))
      return true;
  return false;
}

std::vector<double> ContactTerm::touches(const mechanics::Trial& trial) const {
  std::vector<double> times;
  for (std::size_t t = 0; t < tools_.size(); ++t)
    for (std::size_t k = 0; acts(t, trial.time) && k < surface_->n_points(); ++k)
      if (!closed_on(t, k))
        if (const double share = touching_share(t, k, trial); share > 0.0)
          times.push_back(1.0 - share);
  std::sort(times.begin(), times.end());
  return times;
}

std::vector<Vec3> ContactTerm::turns(std::size_t t, const mechanics::Trial& trial) const {
  std::vector<Vec3> turns(idx(surface_->n_faces()), Vec3::Zero());
  if (predicted_.empty() || pattern_->dim != 3)
    return turns;
  const geometry::Pose pose = this->pose(
      t, trial.time, held_[t] != 0 || rests_[t] != 0 ? trial.x_old : std::span(predicted_));
  const auto n = idx(surface_->points());
  const std::vector<PointHistory>& history = states_[t].history;
  for (std::size_t f = 0; f < turns.size(); ++f) {
    std::vector<Vec3> before, after;
    Vec3 middle_before = Vec3::Zero(), middle_after = Vec3::Zero();
    for (std::size_t k = f * n; k < (f + 1) * n; ++k) {
      before.push_back(history[k].position);
      after.push_back(pose.to_tool(predicted_positions_[k]));
      middle_before += before.back() / double(n);
      middle_after += after.back() / double(n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      before[i] -= middle_before;
      after[i] -= middle_after;
    }
    const Vec3 normal = before[0].cross(before[1]).stableNormalized();
    double sine = 0.0, cosine = 0.0; // of the turn that fits the points best, times their distances
    for (std::size_t i = 0; i < n; ++i) {
      sine += normal.dot(before[i].cross(after[i]));
      cosine += before[i].dot(after[i]);
    }
    constexpr double noticed = 0.01; // rad: what turns by less acts along its chord
    if (const double turn = std::atan2(sine, cosine); std::abs(turn) > noticed)
      turns[f] = -turn * normal;
  }
  return turns;
}

} // namespace billet::contact
