#include "process/stages/tool_activation.h"

#include "geometry/collision/first_contact.h"
#include "process/scene/scene.h"
#include "process/setup/touch.h"
#include "process/stages/overlap.h"
#include "process/state/run.h"
#include "process/state/state.h"
#include "process/tools/drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Moves a tool under a force to where it touches the part.
void come_to_touch(Run& run, std::size_t tool, double time) {
  const geometry::Drive& drive = *run.tools()[tool].motion.force;
  const double sense = first_load(drive.load, time) < 0.0 ? -1.0 : 1.0;
  std::vector<Vec3> points(run.model.surface->n_points());
  run.model.surface->positions(run.state.x, points);
  const auto way = geometry::distance_to_contact(
      *run.tools()[tool].surface, run.model.contact->pose(tool, time, run.state.x),
      sense * drive.axis, points, most_sizes_to_touch * body_size(run.mesh()));
  if (!way)
    return; // it moves away, and the increment says so
  const std::vector<contact::DriveUnknown> drives = contact::drive_unknowns(run.model.tools);
  for (std::size_t j = 0; j < drives.size(); ++j)
    if (drives[j].tool == tool && !drives[j].turns)
      run.state.x[run.n_nodal() + j] += sense * *way;
  run.model.contact->start(tool, run.state.x, time);
  run.state.snapshots.clear(); // states in which the tool is elsewhere
}

/// Keeps that a tool begins to act where the workpiece is, if it does.
void note_initial_penetration(Run& run, std::size_t tool) {
  const double from = std::max(run.state.time, run.tools()[tool].active_from);
  const std::optional<std::string> where = overlap(run, tool, from);
  if (!where)
    return;
  const auto known = std::find_if(run.state.record.initial_penetrations.begin(),
                                  run.state.record.initial_penetrations.end(),
                                  [&](const InitialPenetration& penetration) {
                                    return penetration.tool == tool && penetration.time == from;
                                  });
  if (known != run.state.record.initial_penetrations
                   .end()) // the increment has become shorter since, and others went before
    known->increment = run.state.increment;
  else
    run.state.record.initial_penetrations.push_back({tool, from, *where, run.state.increment});
}

} // namespace

void activate_tools(Run& run, const Stage& stage, double until) {
  if (!run.model.contact)
    return;
  run.state.forces.acted.resize(run.tools().size(), 0);
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const bool acts = !stage.unload && run.model.contact->acts(t, until);
    const bool acted = std::exchange(run.state.forces.acted[t], acts ? 1 : 0) != 0;
    if (!acts || acted || contact::lies_on(*run.model.contact, t) || run.state.increment == 0)
      continue; // before the first increment tools touch and an overlap is refused
    const std::optional<geometry::Drive>& force = run.tools()[t].motion.force;
    if (force && !force->blow)
      come_to_touch(run, t, std::max(run.state.time, run.tools()[t].active_from));
    else
      note_initial_penetration(run, t);
  }
}

std::string initial_penetrations_now(const Run& run) {
  std::string text;
  for (const InitialPenetration& penetration : run.state.record.initial_penetrations)
    if (penetration.increment == run.state.increment)
      text += fmt::format("; tool '{}' begins to act inside the workpiece, {}: a tool goes on its "
                          "way while it does not act",
                          run.tools()[penetration.tool].name, penetration.where);
  return text;
}

} // namespace billet::process
