#include "contact/term/contact_term.h"

#include "contact/term/averaged_faces.h"
#include "contact/term/commit_contact.h"
#include "contact/term/contact_search.h"
#include "contact/term/drive_equations.h"
#include "contact/term/point_tractions.h"
#include "contact/term/shear_yield_tangent.h"
#include "geometry/base/stopwatch.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace billet::contact {

namespace {

/// Gaps below this are rounding of coordinates, of all of them when a tool is brought to touch: a
/// share of the parent element, or of the coordinates in the tool's frame where these are large.
double rounding_of_touch(double depth, const Vec3& position) {
  constexpr double of_depth = 1e-9, of_coordinates = 2e-12;
  return std::max(of_depth * depth, of_coordinates * position.cwiseAbs().maxCoeff());
}

/// Nothing of a tool touches in the trial.
void part(TrialContact& trial) {
  std::fill(trial.traction.begin(), trial.traction.end(), Traction{});
  for (CornerTrial& corner : trial.corners)
    corner.press = CornerPress{};
}

/// Adds the committed forces of a tool's points on the nodes, shape (n_dofs) [N].
void add_point_forces(const ContactModel& model,
                      std::span<const Vec3> forces_of_points,
                      std::span<double> forces) {
  const ContactSurface& surface = *model.surface;
  visit_contact_face(surface.kind(), surface.form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    for (std::size_t k = 0; k < forces_of_points.size(); ++k) {
      const auto nodes = surface.scatter().nodes(model.face_of(k));
      const auto N = Shape::values(Rule::point(static_cast<int>(k) % Rule::points));
      for (std::size_t a = 0; a < N.size(); ++a)
        for (int d = 0; d < dim; ++d)
          forces[idx(nodes[a] * dim + d)] += N[a] * forces_of_points[k][d];
    }
  });
}

} // namespace

ContactTerm::ContactTerm(const ContactSurface& surface,
                         const mechanics::Bulk& bulk,
                         const mechanics::BlockPattern& pattern,
                         std::span<const Tool> tools,
                         double reach,
                         const DriveScale& drives)
    : model_(surface, bulk, pattern, tools, reach, drives), state_(model_),
      sum_(surface.n_points()) {}

void ContactTerm::start(std::span<const double> x, double time) {
  for (std::size_t t = 0; t < state_.tools.size(); ++t)
    start(t, x, time);
}

void ContactTerm::start(std::size_t tool, std::span<const double> x, double time) {
  model_.surface->positions(x, state_.positions);
  ToolContact& contact = state_.tools[tool];
  search(model_, contact, model_.tools[tool], pose(tool, time, x), state_.positions,
         applied_penalty(*model_.surface, state_.penalty));
  for (std::size_t k = 0; k < state_.positions.size(); ++k) {
    PointHistory& history = contact.committed.history[k];
    const geometry::Projection& foot = contact.trial.foot[k];
    history.position = contact.trial.position[k];
    // What lies on the tool sticks from the start; rounding must not decide.
    if (acts(tool, time) && foot.gap <= rounding_of_touch(model_.depth_at(k), history.position))
      history.normal = foot.normal;
  }
}

void ContactTerm::go_on_from(const ContactSnapshot& before, const NewPlaces& at) {
  map_contact(model_, before, at, state_);
}

Outcome<mechanics::Assembled> ContactTerm::assemble(const mechanics::Trial& trial,
                                                    mechanics::System& system) {
  const double begun = seconds_now();
  const double searched = times_.search;
  const AppliedPenalty penalty =
      applied_penalty(*model_.surface, state_.penalty, trial.softening.penetration);
  model_.surface->positions(trial.x, state_.positions);
  sum_.clear();
  for (std::size_t t = 0; t < state_.tools.size(); ++t)
    if (acts(t, trial.time))
      assemble_tool(t, trial, penalty, system);
    else
      part(state_.tools[t].trial);
  sum_.scatter(model_, state_.tools, trial.x, system);
  add_shear_yield_tangent(view(), trial, system);
  add_drive_loads(view(), trial, system);
  add_drive_borders(view(), trial, system);
  times_.elements += seconds_now() - begun - (times_.search - searched);
  return mechanics::Assembled{};
}

void ContactTerm::assemble_tool(std::size_t t,
                                const mechanics::Trial& trial,
                                const AppliedPenalty& penalty,
                                mechanics::System& system) {
  ToolContact& tool = state_.tools[t];
  const geometry::Pose place = pose(t, trial.time, trial.x);
  tool.trial.rotation = place.rotation;
  const double asked = seconds_now();
  search(model_, tool, model_.tools[t], place, state_.positions, penalty);
  times_.search += seconds_now() - asked;
  press_averaged_faces(model_, state_.penalty, penalty, false, tool);
  const bool keep = trial.first_guess && many_parted(model_, tool, penalty);
  if (keep)
    press_averaged_faces(model_, state_.penalty, penalty, true, tool);
  system.contact_changes += evaluate(model_, state_, t, trial, penalty, keep);
  system.kept_contacts = system.kept_contacts || pulls(tool);
  sum_.add(tool.trial, place);
  tool.committed.stabilization.add(*model_.surface, *model_.pattern, trial.x, system);
  press_corners(t, place, trial, penalty, system);
}

void ContactTerm::press_corners(std::size_t t,
                                const geometry::Pose& pose,
                                const mechanics::Trial& trial,
                                const AppliedPenalty& applied,
                                mechanics::System& system) {
  const CornerContact& corners = model_.corners[t];
  ToolContact& tool = state_.tools[t];
  if (corners.empty())
    return;
  const std::function<std::vector<PlaceRate>(const Vec3&)> rates = [&](const Vec3& place) {
    std::vector<PlaceRate> moves;
    for (std::size_t j = 0; j < model_.drives.size(); ++j)
      if (model_.drives[j].tool == t && view().follows(model_.drives[j], trial.time)) {
        const DriveRate rate = model_.drive_rate(model_.drives[j], trial.time, trial.x, place);
        moves.push_back({j, rate.velocity, rate.spin});
      }
    return moves;
  };
  Penalty penalty = applied.penalty;
  penalty.normal /= applied.softening;
  const geometry::Pose pose_old = this->pose(t, trial.time_old, trial.x_old);
  system.contact_changes +=
      corners.add({*model_.surface, *model_.pattern, trial, pose, pose_old, tool.trial.drawn_back,
                   model_.tools[t].friction, penalty, rates},
                  tool.committed.corners, tool.trial.corners, system);
}

void ContactTerm::commit(const mechanics::Trial& trial) { commit_contact(model_, state_, trial); }

void ContactTerm::bear(std::size_t tool,
                       const Vec3& force,
                       const Vec3& place,
                       const mechanics::Trial& trial) {
  ToolLoad& load = state_.loads[tool];
  // Around the full turn radial forces and all torques cancel.
  if (model_.surface->analysis() == mechanics::Analysis::axisymmetric) {
    load.force.y() += force.y();
    return;
  }
  load.force += force;
  const Vec3 reference = pose(tool, trial.time, trial.x).to_space(model_.tools[tool].reference);
  load.torque += (place - reference).cross(force);
}

void ContactTerm::restart() {
  forget_prediction(state_);
  state_.penalty.restart();
  for (ToolContact& tool : state_.tools) {
    TrialContact& trial = tool.trial;
    std::fill(trial.changes.begin(), trial.changes.end(), 0);
    std::fill(trial.friction_lagged.begin(), trial.friction_lagged.end(), char{0});
    for (std::size_t k = 0; k < trial.multiplier.size(); ++k)
      trial.multiplier[k] = tool.committed.history[k].multiplier;
    for (std::size_t c = 0; c < trial.corners.size(); ++c)
      trial.corners[c].multiplier = tool.committed.corners[c].history.multiplier;
  }
}

bool ContactTerm::restart_friction_lagged() {
  std::vector<std::vector<char>> lagged;
  bool any = false;
  for (std::size_t t = 0; t < state_.tools.size(); ++t) {
    const ToolContact& tool = state_.tools[t];
    std::vector<char>& points = lagged.emplace_back(tool.trial.friction_lagged);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k] != 0 || tool.trial.changes[k] < chattering_changes ||
          !had_another_limit(model_, t, k, tool))
        continue;
      points[k] = 1;
      any = true;
    }
  }
  restart();
  for (std::size_t t = 0; t < lagged.size(); ++t)
    state_.tools[t].trial.friction_lagged = std::move(lagged[t]);
  return any;
}

void ContactTerm::augment() {
  for (ToolContact& tool : state_.tools) {
    TrialContact& trial = tool.trial;
    for (std::size_t k = 0; k < trial.traction.size(); ++k)
      trial.multiplier[k] = std::max(0.0, trial.traction[k].pressure);
    for (CornerTrial& corner : trial.corners)
      corner.multiplier = corner.press.traction.pressure;
  }
}

void ContactTerm::retreat(std::size_t tool, double distance, double all) {
  ToolContact& contact = state_.tools[tool];
  contact.trial.retreat = distance;
  contact.trial.drawn_back = all;
  std::fill(contact.search.known_gap.begin(), contact.search.known_gap.end(), 0.0);
}

std::vector<double> ContactTerm::release(std::size_t t) {
  ToolContact& tool = state_.tools[t];
  CommittedContact& committed = tool.committed;
  std::vector<double> forces(idx(model_.pattern->n_dofs()), 0.0);
  add_point_forces(model_, committed.force, forces);
  committed.stabilization.add_forces(*model_.surface, forces);
  add_corner_forces(*model_.surface, committed.corners, forces);
  committed.stabilization.clear();
  forget_averaged_faces(tool);
  for (PointHistory& history : committed.history)
    history = PointHistory{.position = history.position, .sliding = history.sliding};
  std::fill(committed.corners.begin(), committed.corners.end(), CornerState{});
  std::fill(committed.force.begin(), committed.force.end(), Vec3::Zero());
  std::fill(tool.trial.multiplier.begin(), tool.trial.multiplier.end(), 0.0);
  std::fill(tool.trial.corners.begin(), tool.trial.corners.end(), CornerTrial{});
  std::fill(tool.trial.traction.begin(), tool.trial.traction.end(), Traction{});
  state_.work.stored -= committed.stored;
  committed.stored = 0.0;
  committed.touches = false;
  state_.loads[t] = ToolLoad{};
  state_.closed[t].clear();
  return forces;
}

} // namespace billet::contact
