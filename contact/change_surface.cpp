// What a contact term takes over from that on the mesh before. (C.41)

#include "contact/contact_term.h"

#include <algorithm>

namespace billet::contact {

namespace {

/// Gaps up to these shares of the element beneath are what a new mesh is off by.
constexpr double off_outside = 0.02;
constexpr double off_inside = 0.5;

} // namespace

void ContactTerm::go_on_from(const ContactTerm& before, std::span<const PointSource> sources) {
  enabled_ = before.enabled_;
  held_ = before.held_;
  work_ = before.work_;
  times_ = before.times_;
  // Tries that failed on the old mesh say nothing about contact on this one.
  stiffening_ = stiffening_old_ = stiffening_next_ =
      std::max(before.stiffening_old_, before.stiffening_next_);
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    ToolState& state = states_[t];
    for (std::size_t k = 0; k < state.history.size(); ++k) {
      const Vec3 position = state.history[k].position;
      state.history[k] =
          between(before.states_[t], sources[k], state.foot[k], surface_->depth(face_of(k)));
      state.history[k].position = position;
      state.multiplier[k] = state.history[k].multiplier;
      state.touches = state.touches || state.history[k].closed();
    }
  }
}

PointHistory ContactTerm::between(const ToolState& before,
                                  const PointSource& source,
                                  const geometry::Projection& foot,
                                  double depth) const {
  const PointHistory& a = before.history[source.points[0]];
  const PointHistory& b = before.history[source.points[1]];
  const double t = source.share;
  PointHistory history;
  history.sliding = (1.0 - t) * a.sliding + t * b.sliding;
  if (!foot.found() || foot.gap > off_outside * depth || -foot.gap > off_inside * depth)
    return history;
  const bool closed = t < 0.5 ? a.closed() : b.closed();
  if (!closed) {
    history.offset = std::max(0.0, -foot.gap); // touches without pressure, if at all
    return history;
  }
  // At the end of the contact only one of the two has something to say.
  const double share = !a.closed() ? 1.0 : !b.closed() ? 0.0 : t;
  const auto mean = [&](double u, double v) { return (1.0 - share) * u + share * v; };
  history.normal = foot.normal;
  history.pressure = mean(a.pressure, b.pressure);
  history.limit = mean(a.limit, b.limit);
  history.stiffness = mean(a.stiffness, b.stiffness);
  history.multiplier = mean(a.multiplier, b.multiplier);
  history.offset = -foot.gap - (history.pressure - history.multiplier) / penalty().normal;
  if (share < 1.0)
    history.shear += (1.0 - share) * turn(a.shear, a.normal, foot.normal);
  if (share > 0.0)
    history.shear += share * turn(b.shear, b.normal, foot.normal);
  return history;
}

} // namespace billet::contact
