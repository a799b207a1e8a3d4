#include "process/stages/driven_tools.h"

#include "geometry/base/error.h"
#include "geometry/collision/first_contact.h"
#include "process/scene/scene.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/tools/drives.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace billet::process {

namespace {

/// Where a force takes its tool, in the tool's frame.
Vec3 towards(const Run& run, std::size_t tool, double load) {
  const Vec3 way = std::copysign(1.0, load) * run.tools()[tool].motion.force->axis;
  return run.model.contact->pose(tool, run.state.time, run.state.x).rotation.transpose() * way;
}

/// Whether a tool that lies on the part by no more than rounding meets it on a way, once it is
/// clear of it by a little.
///
/// @param aside  where it is taken first, a unit vector; then it goes along `way`
bool meets_part(const Run& run, std::size_t tool, double time, const Vec3& aside, const Vec3& way) {
  constexpr double clear = 1e-3; // of the body
  const double size = body_size(run.mesh());
  geometry::Pose pose = run.model.contact->pose(tool, time, run.state.x);
  pose.translation += clear * size * aside;
  std::vector<Vec3> points(run.model.surface->n_points());
  run.model.surface->positions(run.state.x, points);
  const double reach = aside == way ? size : 2.0 * clear * size;
  return geometry::distance_to_contact(*run.tools()[tool].surface, pose, way, points, reach)
      .has_value();
}

/// Where a force takes its tool, in space.
Vec3 way_of(const Run& run, std::size_t tool, double load) {
  return std::copysign(1.0, load) * run.tools()[tool].motion.force->axis;
}

/// Whether the first load on a tool takes it away from the part for good.
bool is_pulled_off(const Run& run, std::size_t tool) {
  const double load = first_load(run.tools()[tool].motion.force->load, 0.0);
  if (load == 0.0 || contact_under(run.model.contact->state().tools[tool].committed.history,
                                   towards(run, tool, load)) != DriveState::Contact::pulls_off)
    return false;
  // In a hole, or between two walls, it may come to the other side.
  const Vec3 way = way_of(run, tool, load);
  return !meets_part(run, tool, 0.0, way, way);
}

/// What a load does with the contact of its tool. At the moment at which a load changes its sign it
/// is left to rounding whether anything touches: what matters is on which side the part lies.
DriveState::Contact contact_of(const Run& run, std::size_t tool, double load) {
  const auto& history = run.model.contact->state().tools[tool].committed.history;
  const DriveState::Contact found = contact_under(history, towards(run, tool, load));
  if (found != DriveState::Contact::none)
    return found;
  const Vec3 way = way_of(run, tool, load);
  return meets_part(run, tool, run.state.time, way, -way) ? DriveState::Contact::pulls_off : found;
}

} // namespace

void check_drives(const Run& run) {
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const contact::Tool& tool = run.tools()[t];
    const bool pressed = tool.motion.force && !tool.motion.force->blow; // a blow begins by touching
    if (pressed && run.model.contact->acts(t, 0.0) && !contact::lies_on(*run.model.contact, t))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("tool '{}' is driven by a force but does not touch the workpiece: "
                              "nothing tells where it is",
                              tool.name),
                  "give it touch = true, or place it where it touches");
    if (pressed && run.model.contact->acts(t, 0.0) && is_pulled_off(run, t))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("the force on tool '{}' pulls it off the workpiece: contact pushes "
                              "only, and nothing holds the tool",
                              tool.name),
                  "turn its direction round, or give the force the other sign");
  }
}

std::vector<DriveState> drive_states(const Run& run, double time) {
  std::vector<DriveState> states;
  if (!run.model.contact)
    return states;
  const contact::ContactState& contact = run.model.contact->state();
  const contact::DriveScale scale = drive_scale(run.scene, run.part());
  const std::vector<contact::DriveUnknown> drives = contact::drive_unknowns(run.model.tools);
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const auto [tool, turns] = drives[j];
    const geometry::Motion& motion = run.tools()[tool].motion;
    if (!run.model.contact->acts(tool, time) || contact.activity.held(tool) ||
        (!turns && motion.force->blow))
      continue;
    const std::size_t i = run.n_nodal() + j;
    const double arm = turns ? scale.length : 1.0;
    const double held =
        scale.stiffness * (run.attempt.x[i] - run.state.x[i]); // so that nothing is singular
    const double load = (turns ? *motion.torque : *motion.force).load(time);
    DriveState state{tool, turns, load, load + arm * (run.model.newton->residual()[i] - held),
                     DriveState::Contact::presses};
    if (!turns)
      state.contact = contact_of(run, tool, load);
    states.push_back(state);
  }
  return states;
}

std::string unbalanced_loads(const Run& run, double time) {
  std::string text;
  for (const DriveState& drive : drive_states(run, time))
    if (const std::string what = complaint_about(drive, run.tools()[drive.tool].name);
        !what.empty())
      text += "; " + what;
  return text;
}

} // namespace billet::process
