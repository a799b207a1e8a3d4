// Tools that begin to act in the midst of a run: under a load they come to touch, on a prescribed
// way they may find the workpiece where they are.

#include "geometry/collision/first_contact.h"
#include "process/drives.h"
#include "process/remeshing.h"
#include "process/run.h"
#include "process/tool_meetings.h"
#include "process/touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace billet::process {

void Process::activate_tools(const Stage& stage, double until) {
  if (!contact_)
    return;
  state_.forces.acted.resize(scene_.tools.size(), 0);
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    const bool acts = !stage.unload && contact_->acts(t, until);
    const bool acted = std::exchange(state_.forces.acted[t], acts ? 1 : 0) != 0;
    if (!acts || acted || contact::lies_on(*contact_, t) || state_.increment == 0)
      continue; // before the first increment tools touch and an overlap is refused
    const std::optional<geometry::Drive>& force = scene_.tools[t].motion.force;
    if (force && !force->blow)
      come_to_touch(t, std::max(state_.time, scene_.tools[t].active_from));
    else
      note_initial_penetration(t);
  }
}

std::vector<ToolMeeting> Process::overlapping_tools() const {
  std::vector<geometry::Pose> poses;
  for (std::size_t t = 0; contact_ && t < scene_.tools.size(); ++t)
    poses.push_back(contact_->pose(t, state_.time, state_.x));
  return contact_ ? overlaps_by_loads(scene_, state_.time, poses) : std::vector<ToolMeeting>{};
}

void Process::come_to_touch(std::size_t tool, double time) {
  const geometry::Drive& drive = *scene_.tools[tool].motion.force;
  const double sense = first_load(drive.load, time) < 0.0 ? -1.0 : 1.0;
  std::vector<Vec3> points(surface_->n_points());
  surface_->positions(state_.x, points);
  const auto way = geometry::distance_to_contact(
      *scene_.tools[tool].surface, contact_->pose(tool, time, state_.x), sense * drive.axis, points,
      most_sizes_to_touch * body_size(scene_.mesh));
  if (!way)
    return; // it moves away, and the increment says so
  const std::vector<contact::DriveUnknown> drives = contact::drive_unknowns(scene_.tools);
  for (std::size_t j = 0; j < drives.size(); ++j)
    if (drives[j].tool == tool && !drives[j].turns)
      state_.x[state_.origins.size() + j] += sense * *way;
  contact_->start(tool, state_.x, time);
  state_.snapshots.clear(); // states in which the tool is elsewhere
}

void Process::note_initial_penetration(std::size_t tool) {
  const double from = std::max(state_.time, scene_.tools[tool].active_from);
  std::string where = overlap(tool, from);
  if (where.empty())
    return;
  const auto known = std::find_if(state_.record.initial_penetrations.begin(),
                                  state_.record.initial_penetrations.end(),
                                  [&](const InitialPenetration& penetration) {
                                    return penetration.tool == tool && penetration.time == from;
                                  });
  if (known != state_.record.initial_penetrations
                   .end()) // the increment has become shorter since, and others went before
    known->increment = state_.increment;
  else
    state_.record.initial_penetrations.push_back({tool, from, std::move(where), state_.increment});
}

std::string Process::initial_penetrations_now() const {
  std::string text;
  for (const InitialPenetration& penetration : state_.record.initial_penetrations)
    if (penetration.increment == state_.increment)
      text += fmt::format("; tool '{}' begins to act inside the workpiece, {}: a tool goes on its "
                          "way while it does not act",
                          scene_.tools[penetration.tool].name, penetration.where);
  return text;
}

} // namespace billet::process
