#include "contact/term/map_contact.h"

#include <algorithm>
#include <array>
#include <vector>

namespace billet::contact {

namespace {

/// Gaps up to these shares of the parent element are what a new mesh is off by.
constexpr double off_outside = 0.02;
constexpr double off_inside = 0.5;

using Histories = std::span<const PointHistory>;

/// Weights of the points that a new one lies between, of those that are closed. At the end of the
/// contact only these have something to say.
std::array<double, 3> weights_of_closed(Histories before, const PointSource& source) {
  const auto closed = [&](std::size_t i) { return before[source.points[i]].closed(); };
  std::array<double, 3> weights = source.weights;
  double touching = 0.0;
  bool all = true;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) {
      all = all && closed(i);
      touching += closed(i) ? weights[i] : 0.0;
    }
  for (std::size_t i = 0; i < weights.size() && !all; ++i)
    weights[i] = closed(i) ? weights[i] / touching : 0.0;
  return weights;
}

/// History of a point that lies between points of an earlier surface.
///
/// @param depth   of the parent element [mm]
/// @param normal  penalty [MPa/mm]
PointHistory history_between(Histories before,
                             const PointSource& source,
                             const geometry::Projection& foot,
                             double depth,
                             double normal) {
  PointHistory history;
  for (std::size_t i = 0; i < source.weights.size(); ++i)
    if (source.weights[i] > 0.0)
      history.sliding += source.weights[i] * before[source.points[i]].sliding;
  if (!foot.found() || foot.gap > off_outside * depth || -foot.gap > off_inside * depth)
    return history;
  if (!before[source.nearest()].closed()) {
    history.offset = std::max(0.0, -foot.gap); // touches without pressure, if at all
    return history;
  }
  const std::array<double, 3> weights = weights_of_closed(before, source);
  history.normal = foot.normal;
  history.slips = before[source.nearest()].slips;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0)
      continue;
    const PointHistory& from = before[source.points[i]];
    history.pressure += weights[i] * from.pressure;
    history.limit += weights[i] * from.limit;
    history.stiffness += weights[i] * from.stiffness;
    history.multiplier += weights[i] * from.multiplier;
    history.shear += weights[i] * turn(from.shear, from.normal, foot.normal);
  }
  history.offset = -foot.gap - (history.pressure - history.multiplier) / normal;
  return history;
}

} // namespace

ContactSnapshot snapshot(const ContactState& state) {
  ContactSnapshot made{
      state.activity, state.work, std::max(state.penalty.committed, state.penalty.next), {}, {}};
  for (const ToolContact& tool : state.tools) {
    made.history.push_back(tool.committed.history);
    made.corners.push_back(tool.committed.corners);
  }
  return made;
}

void map_contact(const ContactModel& model,
                 const ContactSnapshot& before,
                 const NewPlaces& at,
                 ContactState& state) {
  state.activity.go_on_from(before.activity);
  state.work = before.work;
  state.penalty = {before.stiffening, before.stiffening, before.stiffening};
  const double normal = applied_penalty(*model.surface, state.penalty).penalty.normal;
  for (std::size_t t = 0; t < state.tools.size(); ++t) {
    CommittedContact& committed = state.tools[t].committed;
    TrialContact& tried = state.tools[t].trial;
    committed.touches = false;
    for (std::size_t k = 0; k < committed.history.size(); ++k) {
      const Vec3 position = committed.history[k].position;
      PointHistory& history = committed.history[k];
      history = history_between(before.history[t], at.sources[k], tried.foot[k], model.depth_at(k),
                                normal);
      history.position = position;
      tried.multiplier[k] = history.multiplier;
      committed.touches = committed.touches || history.closed();
    }
    const geometry::Pose pose = model.pose(t, at.time, at.x);
    committed.corners =
        model.corners[t].mapped(before.corners[t], {*model.surface, pose, at.x}, normal);
    for (std::size_t c = 0; c < committed.corners.size(); ++c) {
      const PointHistory& history = committed.corners[c].history;
      tried.corners[c].multiplier = history.multiplier;
      committed.touches = committed.touches || history.closed();
    }
  }
}

} // namespace billet::contact
