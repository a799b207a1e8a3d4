#include "process/tools/drives.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>

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

} // namespace billet::process
