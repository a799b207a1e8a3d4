#include "process/drives.h"

#include "geometry/collision/first_contact.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace billet::process {

bool DriveState::balanced() const {
  constexpr double most = 0.1; // of the load
  return std::abs(load - answer) <= most * std::abs(load);
}

double first_load(const TimeFunction& load, double time) {
  if (const double now = load(time); now != 0.0)
    return now;
  for (const auto& [at, value] : load.points())
    if (at > time && value != 0.0)
      return value;
  return 0.0;
}

DriveState::Contact contact_under(std::span<const contact::PointHistory> history,
                                  const Vec3& direction) {
  constexpr double along = 1e-6; // a wall that is parallel to the way neither stops nor lets go
  bool touches = false;
  for (const contact::PointHistory& point : history) {
    if (!point.closed())
      continue;
    if (point.normal.dot(direction) > -along)
      return DriveState::Contact::presses;
    touches = true;
  }
  return touches ? DriveState::Contact::pulls_off : DriveState::Contact::none;
}

std::string complaint_about(const DriveState& drive, const std::string& tool) {
  if (drive.load == 0.0)
    return "";
  if (!drive.turns && drive.contact == DriveState::Contact::pulls_off)
    return fmt::format("the force of {:.6g} pulls tool '{}' off the workpiece, and nothing holds "
                       "it there",
                       drive.load, tool);
  if (!drive.turns && drive.contact == DriveState::Contact::none)
    return fmt::format("tool '{}', under a force of {:.6g}, has left the workpiece, and nothing "
                       "stops it",
                       tool, drive.load);
  if (drive.turns && !drive.balanced())
    return fmt::format("nothing balances the torque of {:.6g} on tool '{}': contact and friction "
                       "answer with {:.3g}",
                       drive.load, tool, drive.answer);
  return "";
}

std::vector<DriveState> Process::drive_states(double time) const {
  std::vector<DriveState> states;
  if (!contact_)
    return states;
  const contact::ContactState& contact = contact_->state();
  const contact::DriveScale scale = drive_scale();
  const std::vector<contact::DriveUnknown> drives = contact::drive_unknowns(scene_.tools);
  for (std::size_t j = 0; j < drives.size(); ++j) {
    const auto [tool, turns] = drives[j];
    const geometry::Motion& motion = scene_.tools[tool].motion;
    if (!contact_->acts(tool, time) || contact.activity.held(tool) ||
        (!turns && motion.force->blow))
      continue;
    const std::size_t i = state_.origins.size() + j;
    const double arm = turns ? scale.length : 1.0;
    const double held =
        scale.stiffness * (trial_x_[i] - state_.x[i]); // so that nothing is singular
    const double load = (turns ? *motion.torque : *motion.force).load(time);
    DriveState state{tool, turns, load, load + arm * (newton_->residual()[i] - held),
                     DriveState::Contact::presses};
    if (!turns)
      state.contact = contact_under(contact.tools[tool].committed.history, towards(tool, load));
    states.push_back(state);
  }
  return states;
}

/// Where a force takes its tool, in the tool's frame.
Vec3 Process::towards(std::size_t tool, double load) const {
  const Vec3 way = std::copysign(1.0, load) * scene_.tools[tool].motion.force->axis;
  return contact_->pose(tool, state_.time, state_.x).rotation.transpose() * way;
}

std::string Process::unbalanced_loads(double time) const {
  std::string text;
  for (const DriveState& drive : drive_states(time))
    if (const std::string what = complaint_about(drive, scene_.tools[drive.tool].name);
        !what.empty())
      text += "; " + what;
  return text;
}

/// Whether the first load on a tool takes it away from the part for good.
bool Process::is_pulled_off(std::size_t tool) const {
  const geometry::Drive& drive = *scene_.tools[tool].motion.force;
  const double load = first_load(drive.load, 0.0);
  if (load == 0.0 || contact_under(contact_->state().tools[tool].committed.history,
                                   towards(tool, load)) != DriveState::Contact::pulls_off)
    return false;
  // In a hole, or between two walls, it may come to the other side.
  constexpr double clear = 1e-3; // of the body
  const Vec3 way = std::copysign(1.0, load) * drive.axis;
  const double size = body_size(scene_.mesh);
  geometry::Pose pose = contact_->pose(tool, 0.0, state_.x);
  pose.translation += clear * size * way;
  std::vector<Vec3> points(surface_->n_points());
  surface_->positions(state_.x, points);
  return !geometry::distance_to_contact(*scene_.tools[tool].surface, pose, way, points, size);
}

} // namespace billet::process
