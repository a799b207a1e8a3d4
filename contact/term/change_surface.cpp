// What a contact term takes over from that on the mesh before. (C.41)

#include "contact/term/contact_term.h"

#include <algorithm>
#include <array>

namespace billet::contact {

namespace {

/// Gaps up to these shares of the element beneath are what a new mesh is off by.
constexpr double off_outside = 0.02;
constexpr double off_inside = 0.5;

} // namespace

ContactState ContactTerm::state() const {
  // Tries that failed on this mesh say nothing about contact on another one.
  ContactState state{enabled_, held_, work_, std::max(stiffening_old_, stiffening_next_), {}, {}};
  for (const ToolState& tool : states_) {
    state.history.push_back(tool.history);
    const auto corners = tool.corners.corners();
    state.corners.emplace_back(corners.begin(), corners.end());
  }
  return state;
}

void ContactTerm::go_on_from(const ContactState& before,
                             std::span<const PointSource> sources,
                             std::span<const double> x,
                             double time) {
  enabled_ = before.enabled;
  held_ = before.held;
  work_ = before.work;
  stiffening_ = stiffening_old_ = stiffening_next_ = before.stiffening;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    ToolState& state = states_[t];
    state.touches = false;
    for (std::size_t k = 0; k < state.history.size(); ++k) {
      const Vec3 position = state.history[k].position;
      state.history[k] =
          between(before.history[t], sources[k], state.foot[k], surface_->depth(face_of(k)));
      state.history[k].position = position;
      state.multiplier[k] = state.history[k].multiplier;
      state.touches = state.touches || state.history[k].closed();
    }
    state.corners.go_on_from(before.corners[t], *surface_, pose(t, time, x), x, penalty().normal);
    for (const CornerContact::Corner& corner : state.corners.corners())
      state.touches = state.touches || corner.history.closed();
  }
}

PointHistory ContactTerm::between(std::span<const PointHistory> before,
                                  const PointSource& source,
                                  const geometry::Projection& foot,
                                  double depth) const {
  const auto old = [&](std::size_t i) -> const PointHistory& { return before[source.points[i]]; };
  PointHistory history;
  std::array<double, 3> weights = source.weights;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0)
      history.sliding += weights[i] * old(i).sliding;
  if (!foot.found() || foot.gap > off_outside * depth || -foot.gap > off_inside * depth)
    return history;
  if (!before[source.nearest()].closed()) {
    history.offset = std::max(0.0, -foot.gap); // touches without pressure, if at all
    return history;
  }
  // At the end of the contact only those that touch have something to say.
  double touching = 0.0;
  bool all = true;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) {
      all = all && old(i).closed();
      touching += old(i).closed() ? weights[i] : 0.0;
    }
  for (std::size_t i = 0; i < weights.size() && !all; ++i)
    weights[i] = old(i).closed() ? weights[i] / touching : 0.0;
  history.normal = foot.normal;
  history.slips = before[source.nearest()].slips;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0)
      continue;
    const PointHistory& from = old(i);
    history.pressure += weights[i] * from.pressure;
    history.limit += weights[i] * from.limit;
    history.stiffness += weights[i] * from.stiffness;
    history.multiplier += weights[i] * from.multiplier;
    history.shear += weights[i] * turn(from.shear, from.normal, foot.normal);
  }
  history.offset = -foot.gap - (history.pressure - history.multiplier) / penalty().normal;
  return history;
}

} // namespace billet::contact
