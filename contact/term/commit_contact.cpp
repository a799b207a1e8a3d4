#include "contact/term/commit_contact.h"

#include "contact/law/decay.h"
#include "contact/term/averaged_faces.h"
#include "contact/term/point_tractions.h"
#include "contact/term/predicted_contact.h"
#include "contact/term/sagitta_offsets.h"
#include "contact/term/tool_way.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace billet::contact {

namespace {

/// Commits contact with one tool.
class ToolCommit {
public:
  ToolCommit(const ContactModel& model,
             ContactState& state,
             std::size_t tool,
             const mechanics::Trial& trial);

  void points();
  void corners();
  /// Sets the springs that hold the shape of quadratic faces in the next increment. (C.44)
  void springs();

private:
  /// Of the tool or the workpiece in points that touch or touched, in the increment [mm].
  [[nodiscard]] double longest_way() const;
  /// On the workpiece, about the tool's reference point [N mm].
  [[nodiscard]] Vec3 moment_of_springs() const;
  void commit_point(std::size_t k);
  void add_work_of_tool(std::size_t k, const Vec3& force);
  void add_friction(std::size_t k, const Vec3& position, const ShearBalance& shear);
  /// Takes the trial into a point's history.
  ///
  /// @return the history before
  PointHistory renew(std::size_t k, const Vec3& position, double sliding);
  void close(std::size_t k, const PointHistory& old, double stiffness);
  void commit_corner(std::size_t c);
  void close_corner(std::size_t c, const PointHistory& old, double stiffness);
  /// Adds a force on the workpiece at a place to what the tool feels.
  void add_load(const Vec3& force, const Vec3& place);

  const ContactModel& model_;
  ContactState& state_;
  std::size_t index_;
  const mechanics::Trial& trial_;
  const Tool& tool_;
  CommittedContact& committed_;
  TrialContact& tried_;
  geometry::Pose pose_, pose_old_;
  std::array<ToolWay, 2> ways_;
  Vec3 reference_; ///< of torques, in space [mm]
  bool meridian_;  ///< axisymmetric
  Penalty penalty_;
  PenaltyWork penalty_work_;
  bool touched_ = false; ///< when the increment began
  double gone_ = 0.0;    ///< by points that touch or touched [mm]
};

ToolCommit::ToolCommit(const ContactModel& model,
                       ContactState& state,
                       std::size_t tool,
                       const mechanics::Trial& trial)
    : model_(model), state_(state), index_(tool), trial_(trial), tool_(model.tools[tool]),
      committed_(state.tools[tool].committed), tried_(state.tools[tool].trial),
      pose_(model.pose(tool, trial.time, trial.x)),
      pose_old_(model.pose(tool, trial.time_old, trial.x_old)),
      ways_(tool_ways(model, tool, trial)), reference_(pose_.to_space(tool_.reference)),
      meridian_(model.surface->analysis() == mechanics::Analysis::axisymmetric),
      penalty_(applied_penalty(*model.surface, state.penalty).penalty),
      penalty_work_(penalty_.normal, state.penalty) {}

double ToolCommit::longest_way() const {
  double longest = 0.0;
  for (std::size_t k = 0; k < tried_.traction.size(); ++k) {
    const PointHistory& history = committed_.history[k];
    const Vec3& before = history.position;
    if (tried_.traction[k].status != Status::open || history.closed())
      longest = std::max({longest, (pose_.to_space(before) - pose_old_.to_space(before)).norm(),
                          (state_.positions[k] - pose_old_.to_space(before)).norm()});
  }
  for (std::size_t c = 0; c < tried_.corners.size(); ++c)
    if (const CornerPress& press = tried_.corners[c].press; press.foot) {
      const Vec3& centre = model_.corners[index_].shape(c).centre;
      longest = std::max({longest, press.traction.slip.norm(),
                          (pose_.to_space(centre) - pose_old_.to_space(centre)).norm()});
    }
  return longest;
}

void ToolCommit::points() {
  committed_.rotation = pose_.rotation;
  touched_ = committed_.touches;
  committed_.stored = 0.0;
  committed_.touches = false;
  state_.closed[index_].clear();
  gone_ = longest_way();
  for (std::size_t k = 0; k < tried_.traction.size(); ++k)
    commit_point(k);
  if (!meridian_)
    state_.loads[index_].torque -= moment_of_springs();
}

Vec3 ToolCommit::moment_of_springs() const {
  const FaceStabilization& springs = committed_.stabilization;
  return tool_.motion.axis().isZero()
             ? springs.moment(*model_.surface, trial_.x)
             : springs.moment_about({pose_.rotation, tool_.reference}, *model_.surface, trial_.x);
}

void ToolCommit::commit_point(std::size_t k) {
  const Traction& now = tried_.traction[k];
  PointHistory& history = committed_.history[k];
  const double area = state_.areas[k];
  const Vec3 position = pose_.to_tool(state_.positions[k]);
  const Vec3 force = area * (pose_.rotation * now.traction);
  add_work_of_tool(k, force);
  committed_.force[k] = force;
  const double sliding = history.sliding + now.slip.norm();
  const ShearBalance shear = balance(penalty_, history, now, sliding, model_.depth_at(k));
  add_friction(k, position, shear);
  state_.work.penalty_update +=
      area * penalty_work_.update_work(history, now, tried_.multiplier[k]);
  const PointHistory old = renew(k, position, sliding);
  if (now.status == Status::open)
    tried_.multiplier[k] = 0.0;
  else
    close(k, old, shear.stiffness);
}

void ToolCommit::add_work_of_tool(std::size_t k, const Vec3& force) {
  const auto& [way_old, way] = ways_;
  const PointHistory& history = committed_.history[k];
  ContactWork& work = state_.work;
  work.external +=
      0.5 * (force.dot(way.of(state_.positions[k])) +
             committed_.force[k].dot(way_old.of(pose_old_.to_space(history.position))));
  work.external -=
      0.5 * tried_.retreat * state_.areas[k] * (history.pressure + tried_.traction[k].pressure);
}

void ToolCommit::add_friction(std::size_t k, const Vec3& position, const ShearBalance& shear) {
  const PointHistory& history = committed_.history[k];
  const Traction& now = tried_.traction[k];
  const double area = state_.areas[k];
  state_.work.friction += shear.friction_work * area;
  state_.work.unseen += shear.unseen * area;
  // What opens, or comes to a tool that touches already, has rubbed on the way by the trapezoid
  // that the work of tools is taken by: one point's contact passes to another.
  Vec3 rubs = Vec3::Zero();
  if (history.closed() && now.status == Status::open) {
    rubs = history.shear;
    state_.since_parting = -1;
  } else if (touched_ && !history.closed() && tried_.touching[k])
    rubs = (1.0 - *tried_.touching[k]) * now.shear;
  state_.work.friction += area * std::max(0.0, -0.5 * rubs.dot(position - history.position));
}

PointHistory ToolCommit::renew(std::size_t k, const Vec3& position, double sliding) {
  const Traction& now = tried_.traction[k];
  PointHistory& history = committed_.history[k];
  const bool averaged = averaged_pressure(state_.tools[index_], model_.face_of(k)) != nullptr;
  const double correction = averaged ? gap_correction(state_.tools[index_], k, penalty_.normal)
                                     : decayed(history.gap_correction, gone_);
  PointHistory old =
      std::exchange(history, PointHistory{.position = position,
                                          .sliding = sliding,
                                          .offset = std::max(0.0, decayed(history.offset, gone_)),
                                          .sagitta_offset = history.sagitta_offset,
                                          .gap_correction = correction});
  // The correction of averaged faces changes within the increment, the rest at its end.
  const double shift = old.decayed + (averaged ? old.gap_correction - correction : 0.0);
  state_.work.penalty_update += state_.areas[k] * 0.5 * (old.pressure + now.pressure) *
                                penalty_work_.pressed_shift(old, now, tried_.multiplier[k], shift);
  if (!averaged)
    history.decayed += old.gap_correction - correction;
  return old;
}

void ToolCommit::close(std::size_t k, const PointHistory& old, double stiffness) {
  const Traction& now = tried_.traction[k];
  const double area = state_.areas[k];
  PointHistory& history = committed_.history[k];
  history.multiplier = tried_.multiplier[k];
  history.offset = decayed(old.offset, gone_);
  history.decayed += old.offset - history.offset; // closer to the tool: deeper by as much
  history.normal = tried_.foot[k].normal;
  history.shear = now.shear;
  history.pressure = now.pressure;
  history.limit = now.limit;
  history.slips = now.status == Status::slip;
  history.stiffness = stiffness;
  committed_.touches = true;
  state_.closed[index_].push_back(
      {.point = k,
       .from = old.position,
       .to = history.position,
       .foot = tried_.foot[k].foot,
       .normal = history.normal,
       .touching = old.closed() ? 1.0 : tried_.touching[k].value_or(0.0),
       .pressure_old = old.pressure,
       .pressure = now.pressure,
       .slip = now.slip.norm(),
       .sliding = history.sliding,
       .area = area});
  committed_.stored += area * (penalty_work_.stored(now, history.multiplier) +
                               shear_energy(now.shear, history.stiffness));
  add_load(committed_.force[k], state_.positions[k]);
}

void ToolCommit::add_load(const Vec3& force, const Vec3& place) {
  ToolLoad& load = state_.loads[index_];
  // Around the full turn radial forces and all torques cancel.
  const Vec3 on_tool = meridian_ ? Vec3(0.0, -force.y(), 0.0) : Vec3(-force);
  load.force += on_tool;
  if (!meridian_)
    load.torque += (place - reference_).cross(on_tool);
}

void ToolCommit::corners() {
  for (std::size_t c = 0; c < committed_.corners.size(); ++c)
    commit_corner(c);
}

void ToolCommit::commit_corner(std::size_t c) {
  const CornerPress& now = tried_.corners[c].press;
  CornerState& corner = committed_.corners[c];
  const CornerPress& before = corner.press;
  const Traction& T = now.traction;
  PointHistory& history = corner.history;
  ContactWork& work = state_.work;
  const auto& [way_old, way] = ways_;
  const double area = now.foot ? now.area : before.area;
  work.external +=
      0.5 * (now.force.dot(way.of(now.place)) + before.force.dot(way_old.of(before.place)));
  work.external -= 0.5 * tried_.retreat * area * (history.pressure + T.pressure);
  const double sliding = history.sliding + T.slip.norm();
  const ShearBalance shear =
      balance(penalty_, history, T, sliding, now.foot ? now.depth : before.depth);
  work.friction += area * shear.friction_work;
  work.unseen += area * shear.unseen;
  work.penalty_update += area * penalty_work_.update_work(history, T, tried_.corners[c].multiplier);
  const PointHistory old =
      std::exchange(history, PointHistory{.sliding = sliding,
                                          .offset = std::max(0.0, decayed(history.offset, gone_))});
  if (now.foot)
    close_corner(c, old, shear.stiffness);
  else
    tried_.corners[c].multiplier = 0.0;
  corner.press = now;
  corner.press.mean_pressure = 0.5 * (old.pressure + T.pressure);
}

void ToolCommit::close_corner(std::size_t c, const PointHistory& old, double stiffness) {
  const CornerPress& now = tried_.corners[c].press;
  const Traction& T = now.traction;
  const double multiplier = tried_.corners[c].multiplier;
  CornerState& corner = committed_.corners[c];
  PointHistory& history = corner.history;
  history.offset = decayed(old.offset, gone_);
  // Deeper by as much.
  state_.work.penalty_update +=
      now.area * 0.5 * (old.pressure + T.pressure) *
      penalty_work_.pressed_shift(old, T, multiplier, old.offset - history.offset);
  history.multiplier = multiplier;
  history.normal =
      tried_.rotation.transpose() * Vec3(now.foot->normal.x(), now.foot->normal.y(), 0.0);
  history.shear = T.shear;
  history.pressure = T.pressure;
  history.limit = T.limit;
  history.slips = T.status == Status::slip;
  history.stiffness = stiffness;
  committed_.touches = true;
  // A corner that shares its place with the adjacent side has a softer penalty.
  committed_.stored +=
      now.area * (0.5 * (T.pressure + history.multiplier) * (now.foot->depth - old.offset) +
                  shear_energy(history.shear, history.stiffness));
  corner.shear_yield =
      shear_yield(model_, tool_.friction, nearest_point(*model_.surface, *now.foot));
  add_load(now.force, now.place);
}

void ToolCommit::springs() {
  const ContactSurface& surface = *model_.surface;
  if (surface.form() != Form::mixed || surface.linear())
    return;
  FaceStabilization& springs = committed_.stabilization;
  state_.work.penalty_update -= springs.energy(surface, trial_.x);
  springs.set(surface, committed_.history, {*tool_.surface, pose_, model_.reach}, trial_.x,
              std::min(surface.stiffness(), surface.penalty().normal));
  const double stored = springs.energy(surface, trial_.x);
  state_.work.penalty_update += stored;
  committed_.stored += stored;
}

/// Area of the points that touch any tool.
double touched_area(const ContactState& state) {
  double area = 0.0;
  for (std::size_t k = 0; k < state.areas.size(); ++k)
    if (std::any_of(state.tools.begin(), state.tools.end(), [&](const ToolContact& tool) {
          return tool.trial.traction[k].status != Status::open;
        }))
      area += state.areas[k];
  return area;
}

} // namespace

void commit_contact(const ContactModel& model, ContactState& state, const mechanics::Trial& trial) {
  model.surface->areas(trial.x, state.areas);
  state.area = touched_area(state);
  std::fill(state.loads.begin(), state.loads.end(), ToolLoad{});
  state.work.stored = 0.0;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    ToolCommit commit(model, state, t, trial);
    commit.points();
    commit.corners();
    commit.springs();
    state.work.stored += state.tools[t].committed.stored;
    set_sagitta_offsets(model, state.tools[t], t, trial);
    choose_averaged_faces(model, state, t);
  }
  ++state.since_parting;
  state.penalty.commit();
  forget_prediction(state);
}

} // namespace billet::contact
