#include "contact/term/point_tractions.h"

#include "contact/term/averaged_faces.h"
#include "contact/term/contact_search.h"
#include "contact/term/predicted_contact.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

namespace billet::contact {

namespace {

/// What rounding makes of a gap that is zero [mm].
double noise_of_gap(const Vec3& in_space, const Vec3& on_tool) {
  constexpr double units_in_the_last_place = 16.0;
  return units_in_the_last_place * std::numeric_limits<double>::epsilon() *
         (in_space.lpNorm<Eigen::Infinity>() + on_tool.lpNorm<Eigen::Infinity>());
}

} // namespace

bool many_parted(const ContactModel& model,
                 const ToolContact& contact,
                 const AppliedPenalty& penalty) {
  constexpr double many = 0.25; // of the points that touched; fewer, and the guess tells them apart
  int closed = 0;
  int parted = 0;
  for (std::size_t k = 0; k < contact.committed.history.size(); ++k)
    if (contact.committed.history[k].closed()) {
      ++closed;
      const FacePressure* averaged = averaged_pressure(contact, model.face_of(k));
      const bool open = averaged != nullptr
                            ? !(shared_pressure(model, *averaged, k).pressure > 0.0)
                            : contact.trial.foot[k].gap > opening_gap(model, contact, k, penalty);
      parted += open ? 1 : 0;
    }
  return parted > many * closed;
}

bool pulls(const ToolContact& contact) {
  return std::any_of(contact.trial.traction.begin(), contact.trial.traction.end(),
                     [](const Traction& point) { return point.pressure < 0.0; });
}

double shear_yield(const ContactModel& model, const Friction& friction, std::size_t point) {
  const std::optional<FollowedStress> followed = friction.followed_stress();
  if (!followed)
    return 0.0;
  const std::size_t bulk_point = model.surface->bulk_point(point);
  const double stress = *followed == FollowedStress::yield
                            ? model.bulk->trial_flow_stress(bulk_point)
                            : model.bulk->trial_stress(bulk_point).stress;
  return stress / std::numbers::sqrt3;
}

bool had_another_limit(const ContactModel& model,
                       std::size_t tool,
                       std::size_t point,
                       const ToolContact& contact) {
  const PointHistory& old = contact.committed.history[point];
  if (!old.closed() || !(old.pressure > 0.0))
    return false;
  const Friction& friction = model.tools[tool].friction;
  const Traction& now = contact.trial.traction[point];
  const auto limit = [&](double pressure) {
    const SlipState state{pressure, shear_yield(model, friction, point), old.sliding};
    return limit_at(friction, state, now.slip.norm()).shear;
  };
  constexpr double rounding = 1e-9;
  const double before = limit(old.pressure);
  return std::abs(limit(now.pressure) - before) > rounding * before;
}

int evaluate(const ContactModel& model,
             ContactState& state,
             std::size_t t,
             const mechanics::Trial& trial,
             const AppliedPenalty& penalty,
             bool keep) {
  const Tool& tool = model.tools[t];
  ToolContact& contact = state.tools[t];
  TrialContact& tried = contact.trial;
  if (tried.turn.empty())
    tried.turn = turns({model, state}, t, trial);
  int changes = 0;
  for (std::size_t k = 0; k < tried.traction.size(); ++k) {
    const Status before = tried.traction[k].status;
    const geometry::Projection& foot = tried.foot[k];
    const PointHistory& old = contact.committed.history[k];
    const bool kept = keep && old.closed() && foot.found();
    const FacePressure* averaged = averaged_pressure(contact, model.face_of(k));
    const bool opens = averaged != nullptr ? !(shared_pressure(model, *averaged, k).pressure > 0.0)
                                           : !(foot.gap <= opening_gap(model, contact, k, penalty));
    if (opens && !kept) {
      tried.traction[k] = Traction{};
    } else {
      InterfaceInput in{tried.position[k], foot};
      in.projection.gap += old.added();
      in.rounding = touching_gap(model, k);
      in.noise = noise_of_gap(state.positions[k], tried.position[k]);
      in.dt = trial.time - trial.time_old;
      if (!old.closed()) {
        if (!tried.touching[k])
          tried.touching[k] = touching_share({model, state}, t, k, trial);
        in.touching = *tried.touching[k];
      }
      in.softening = trial.softening.slip;
      in.kept = kept;
      in.multiplier = penalty.carried(old, tried.multiplier[k]);
      in.shear_yield = shear_yield(model, tool.friction, k);
      in.friction_lagged = tried.friction_lagged[k] != 0;
      in.turn = tried.turn[idx(model.face_of(k))];
      if (averaged != nullptr)
        in.shared = shared_pressure(model, *averaged, k);
      tried.traction[k] =
          traction(tool.friction, penalty.penalty, old, in, model.surface->scheme());
    }
    if (tried.traction[k].status != before) {
      ++changes;
      ++tried.changes[k];
    }
  }
  return changes;
}

} // namespace billet::contact
