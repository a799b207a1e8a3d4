#include "contact/term/contact_report.h"

#include "contact/term/tool_way.h"

#include <algorithm>
#include <limits>

namespace billet::contact {

std::vector<PointResult> point_results(const ContactView& contact) {
  const auto& [model, state] = contact;
  std::vector<PointResult> results(state.positions.size());
  for (PointResult& point : results)
    point.gap = std::numeric_limits<double>::infinity();
  std::vector<geometry::Projection> feet(results.size());
  for (std::size_t t = 0; t < state.tools.size(); ++t) {
    const CommittedContact& committed = state.tools[t].committed;
    // Not those of the last trial: it may have failed, and knows nothing of points that are far.
    std::vector<Vec3> positions;
    for (const PointHistory& history : committed.history)
      positions.push_back(history.position);
    model.tools[t].surface->project(positions, model.reach, feet);
    for (std::size_t k = 0; k < results.size(); ++k) {
      PointResult& point = results[k];
      const PointHistory& history = committed.history[k];
      point.gap = std::min(point.gap, feet[k].gap);
      point.sliding = std::max(point.sliding, history.sliding);
      point.pressure += history.pressure;
      point.shear += committed.rotation * history.shear;
      point.status = std::max(point.status, history.status());
    }
  }
  return results;
}

std::vector<ChatteringPoint> chattering(const ContactView& contact) {
  const ContactState& state = contact.state;
  std::vector<ChatteringPoint> points;
  for (std::size_t t = 0; t < state.tools.size(); ++t) {
    const std::vector<int>& changes = state.tools[t].trial.changes;
    for (std::size_t k = 0; k < changes.size(); ++k)
      if (changes[k] >= chattering_changes)
        points.push_back({t, state.positions[k], changes[k]});
  }
  std::stable_sort(
      points.begin(), points.end(),
      [](const ChatteringPoint& a, const ChatteringPoint& b) { return a.changes > b.changes; });
  return points;
}

bool friction_lags(const ContactView& contact) {
  constexpr double noticeable = 0.01;
  const ContactState& state = contact.state;
  const auto lags = [&](const ToolContact& tool) {
    double off = 0.0, friction = 0.0;
    for (std::size_t k = 0; k < tool.trial.traction.size(); ++k) {
      off += state.areas[k] * tool.trial.traction[k].lag;
      friction += state.areas[k] * tool.trial.traction[k].shear.norm();
    }
    return off > noticeable * friction;
  };
  return std::any_of(state.tools.begin(), state.tools.end(), lags);
}

bool closed_on(const ContactView& contact, std::size_t tool, std::size_t point) {
  return contact.state.tools[tool].committed.history[point].closed();
}

double depth_of_pressure(const ContactView& contact, std::size_t tool, std::size_t point) {
  const auto& [model, state] = contact;
  const PointHistory& history = state.tools[tool].committed.history[point];
  return std::max(0.0, history.pressure - history.multiplier) /
         applied_penalty(*model.surface, state.penalty).penalty.normal;
}

const Traction& trial_traction(const ContactView& contact, std::size_t tool, std::size_t point) {
  return contact.state.tools[tool].trial.traction[point];
}

std::span<const CornerState> corners(const ContactView& contact, std::size_t tool) {
  return contact.state.tools[tool].committed.corners;
}

double bearing_area(const ContactView& contact) {
  double area = contact.state.area;
  for (const ToolContact& tool : contact.state.tools)
    for (const CornerState& corner : tool.committed.corners)
      if (corner.press.foot)
        area += corner.press.area;
  return area;
}

std::array<ForcesOfTool, 2>
forces_of_tool(const ContactView& contact, std::size_t t, const mechanics::Trial& trial) {
  const auto& [model, state] = contact;
  const CommittedContact& committed = state.tools[t].committed;
  const TrialContact& tried = state.tools[t].trial;
  const geometry::Pose pose = model.pose(t, trial.time, trial.x);
  const geometry::Pose pose_old = model.pose(t, trial.time_old, trial.x_old);
  const auto [way_old, way] = tool_ways(model, t, trial);
  ForcesOfTool before, now;
  const auto add = [](ForcesOfTool& forces, const Vec3& force, const Vec3& way_of_point) {
    forces.sum += force.norm();
    forces.work += force.dot(way_of_point);
  };
  for (std::size_t k = 0; k < tried.traction.size(); ++k) {
    const PointHistory& history = committed.history[k];
    if (history.closed())
      add(before, committed.force[k], way_old.of(pose_old.to_space(history.position)));
    if (tried.traction[k].status != Status::open)
      add(now, state.areas[k] * (pose.rotation * tried.traction[k].traction),
          way.of(state.positions[k]));
  }
  for (std::size_t c = 0; c < committed.corners.size(); ++c) {
    const CornerPress& press_old = committed.corners[c].press;
    const CornerPress& press = tried.corners[c].press;
    add(before, press_old.force, way_old.of(press_old.place));
    add(now, press.force, way.of(press.place));
  }
  return {before, now};
}

bool lies_on(const ContactView& contact, std::size_t tool) {
  const CommittedContact& committed = contact.state.tools[tool].committed;
  return std::any_of(committed.history.begin(), committed.history.end(),
                     [](const PointHistory& history) { return history.closed(); }) ||
         std::any_of(committed.corners.begin(), committed.corners.end(),
                     [](const CornerState& corner) { return corner.history.closed(); });
}

bool bears_near(const ContactView& contact, std::size_t tool, Index face) {
  const mechanics::Scatter& faces = contact.model.surface->scatter();
  const TrialContact& trial = contact.state.tools[tool].trial;
  const auto own = faces.nodes(face);
  const auto is_near = [&](Index other) {
    const auto nodes = faces.nodes(other);
    return std::find_first_of(own.begin(), own.end(), nodes.begin(), nodes.end()) != own.end();
  };
  for (std::size_t k = 0; k < trial.traction.size(); ++k)
    if (trial.traction[k].pressure > 0.0 && is_near(contact.model.face_of(k)))
      return true;
  return std::any_of(trial.corners.begin(), trial.corners.end(), [&](const CornerTrial& corner) {
    return corner.press.foot && corner.press.area > 0.0 && is_near(corner.press.foot->face);
  });
}

bool draws_back(const ContactView& contact, std::size_t tool) {
  return contact.state.tools[tool].trial.drawn_back > 0.0;
}

bool leaves(const ContactView& contact, std::size_t tool, double time) {
  return contact.state.tools[tool].committed.touches && !contact.acts(tool, time);
}

} // namespace billet::contact
