// What a tool's corners add to its contact: forces, loads, works. (C.46)

#include "contact/law/fading.h"
#include "contact/term/contact_term.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace billet::contact {

void ContactTerm::press_corners(std::size_t tool,
                                const geometry::Pose& pose,
                                const mechanics::Trial& trial,
                                mechanics::System& system) {
  CornerContact& corners = states_[tool].corners;
  if (corners.empty())
    return;
  const std::function<std::vector<PlaceRate>(const Vec3&)> rates = [&](const Vec3& place) {
    std::vector<PlaceRate> moves;
    for (std::size_t j = 0; j < drives_.size(); ++j)
      if (drives_[j].tool == tool && follows(drives_[j], trial.time)) {
        const DriveRate rate = drive_rate(drives_[j], trial.time, trial.x, place);
        moves.push_back({j, rate.velocity, rate.spin});
      }
    return moves;
  };
  Penalty penalty = this->penalty();
  penalty.normal /= softening_;
  const geometry::Pose pose_old = this->pose(tool, trial.time_old, trial.x_old);
  system.contact_changes += corners.add(
      *surface_, *pattern_,
      {trial, pose, pose_old, states_[tool].drawn_back, tools_[tool].friction, penalty, rates},
      system);
}

double ContactTerm::bearing_area() const {
  double area = area_;
  for (const ToolState& state : states_)
    for (const CornerContact::Corner& corner : state.corners.corners())
      if (corner.committed.foot)
        area += corner.committed.area;
  return area;
}

void ContactTerm::commit_corners(std::size_t tool, const mechanics::Trial& trial, double gone) {
  ToolState& state = states_[tool];
  const auto [way_old, way] = ways(tool, trial);
  const Vec3 reference = pose(tool, trial.time, trial.x).to_space(tools_[tool].reference);
  const bool meridian = surface_->analysis() == mechanics::Analysis::axisymmetric;
  for (CornerContact::Corner& corner : state.corners.corners()) {
    const CornerPress& now = corner.trial;
    const CornerPress& before = corner.committed;
    const Traction& T = now.traction;
    PointHistory& history = corner.history;
    const double area = now.foot ? now.area : before.area;
    work_.external +=
        0.5 * (now.force.dot(way.of(now.place)) + before.force.dot(way_old.of(before.place)));
    work_.external -= 0.5 * state.retreat * area * (history.pressure + T.pressure);
    const double sliding = history.sliding + T.slip.norm();
    const ShearBalance shear =
        balance(penalty(), history, T, sliding, now.foot ? now.depth : before.depth);
    work_.friction += area * shear.friction_work;
    work_.unseen += area * shear.unseen;
    work_.enforcement += area * enforcement_work(history, T, corner.multiplier);
    const PointHistory old =
        std::exchange(history, PointHistory{.sliding = sliding,
                                            .offset = std::max(0.0, faded(history.offset, gone))});
    if (!now.foot) {
      corner.multiplier = 0.0;
    } else {
      history.offset = faded(old.offset, gone);
      // Deeper by as much.
      work_.enforcement += area * 0.5 * (old.pressure + T.pressure) *
                           pressed_shift(old, T, corner.multiplier, old.offset - history.offset);
      history.multiplier = corner.multiplier;
      history.normal =
          state.rotation.transpose() * Vec3(now.foot->normal.x(), now.foot->normal.y(), 0.0);
      history.shear = T.shear;
      history.pressure = T.pressure;
      history.limit = T.limit;
      history.slips = T.status == Status::slip;
      history.stiffness = shear.stiffness;
      state.touches = true;
      // A corner that shares its place with the side beside it has a softer penalty.
      state.stored +=
          area * (0.5 * (T.pressure + history.multiplier) * (now.foot->depth - old.offset) +
                  shear_energy(history.shear, history.stiffness));
      corner.strength = strength(tools_[tool].friction, nearest_point(*surface_, *now.foot));
      // Around the full turn radial forces and all torques cancel.
      const Vec3 on_tool = meridian ? Vec3(0.0, -now.force.y(), 0.0) : Vec3(-now.force);
      loads_[tool].force += on_tool;
      if (!meridian)
        loads_[tool].torque += (now.place - reference).cross(on_tool);
    }
    corner.committed = now;
    corner.committed.mean_pressure = 0.5 * (old.pressure + T.pressure);
  }
}

} // namespace billet::contact
