#include "contact/term/predicted_contact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace billet::contact {

namespace {

/// The unknowns that tell where a tool will be at the end of the increment.
std::span<const double>
predicted_unknowns(const ContactView& contact, std::size_t tool, const mechanics::Trial& trial) {
  const ToolActivity& activity = contact.state.activity;
  return activity.held(tool) || activity.rests(tool) ? trial.x_old
                                                     : std::span(contact.state.predicted.unknowns);
}

/// The turn that fits best the way of points around their centre from one place to another, as a
/// vector, by which a face turns against a tool.
///
/// @return nothing: it is so small that what turns acts along its chord
std::optional<Vec3> turn_of(std::vector<Vec3> before, std::vector<Vec3> after) {
  const std::size_t n = before.size();
  Vec3 middle_before = Vec3::Zero(), middle_after = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    middle_before += before[i] / double(n);
    middle_after += after[i] / double(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    before[i] -= middle_before;
    after[i] -= middle_after;
  }
  const Vec3 normal = before[0].cross(before[1]).stableNormalized();
  double sine = 0.0, cosine = 0.0; // times their distances
  for (std::size_t i = 0; i < n; ++i) {
    sine += normal.dot(before[i].cross(after[i]));
    cosine += before[i].dot(after[i]);
  }
  constexpr double noticed = 0.01; // rad
  if (const double turn = std::atan2(sine, cosine); std::abs(turn) > noticed)
    return -turn * normal;
  return std::nullopt;
}

} // namespace

void predict(const ContactModel& model, ContactState& state, std::span<const double> x) {
  forget_prediction(state);
  state.predicted.unknowns.assign(x.begin(), x.end());
  model.surface->positions(x, state.predicted.positions);
}

void forget_prediction(ContactState& state) {
  state.predicted.unknowns.clear();
  for (ToolContact& tool : state.tools) {
    std::fill(tool.trial.touching.begin(), tool.trial.touching.end(), std::nullopt);
    tool.trial.turn.clear();
  }
}

double touching_share(const ContactView& contact,
                      std::size_t t,
                      std::size_t point,
                      const mechanics::Trial& trial) {
  const auto& [model, state] = contact;
  if (state.predicted.unknowns.empty())
    return 0.0;
  const PointHistory& history = state.tools[t].committed.history[point];
  const geometry::Pose pose = model.pose(t, trial.time, predicted_unknowns(contact, t, trial));
  const std::array<Vec3, 2> places{history.position,
                                   pose.to_tool(state.predicted.positions[point])};
  std::array<geometry::Projection, 2> feet;
  for (geometry::Projection& foot : feet)
    foot.patch = state.tools[t].trial.foot[point].patch;
  model.tools[t].surface->project(places, model.reach, feet);
  const double before = feet[0].gap + history.added();
  const double after = feet[1].gap + history.added();
  if (!feet[0].found() || !feet[1].found() || !(after < 0.0))
    return 0.0;
  return before > 0.0 ? after / (after - before) : 1.0;
}

bool any_turns(const ContactView& contact, const mechanics::Trial& trial) {
  const ContactModel& model = contact.model;
  const auto angle = [&](std::size_t t, double time, std::span<const double> x) {
    return model.tools[t].motion.angle(time, model.driven(t, x));
  };
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (contact.acts(t, trial.time) &&
        angle(t, trial.time, trial.x) != angle(t, trial.time_old, trial.x_old))
      return true;
  return false;
}

std::vector<double> touches(const ContactView& contact, const mechanics::Trial& trial) {
  std::vector<double> times;
  for (std::size_t t = 0; t < contact.model.tools.size(); ++t) {
    const std::vector<PointHistory>& history = contact.state.tools[t].committed.history;
    for (std::size_t k = 0; contact.acts(t, trial.time) && k < history.size(); ++k)
      if (!history[k].closed())
        if (const double share = touching_share(contact, t, k, trial); share > 0.0)
          times.push_back(1.0 - share);
  }
  std::sort(times.begin(), times.end());
  return times;
}

std::vector<Vec3> turns(const ContactView& contact, std::size_t t, const mechanics::Trial& trial) {
  const auto& [model, state] = contact;
  std::vector<Vec3> turns(idx(model.surface->n_faces()), Vec3::Zero());
  if (state.predicted.unknowns.empty() || model.pattern->dim != 3)
    return turns;
  const geometry::Pose pose = model.pose(t, trial.time, predicted_unknowns(contact, t, trial));
  const auto n = idx(model.surface->points());
  const std::vector<PointHistory>& history = state.tools[t].committed.history;
  for (std::size_t f = 0; f < turns.size(); ++f) {
    std::vector<Vec3> before, after;
    for (std::size_t k = f * n; k < (f + 1) * n; ++k) {
      before.push_back(history[k].position);
      after.push_back(pose.to_tool(state.predicted.positions[k]));
    }
    if (const std::optional<Vec3> turn = turn_of(std::move(before), std::move(after)))
      turns[f] = *turn;
  }
  return turns;
}

} // namespace billet::contact
