#include "process/stages/overlap.h"

#include "geometry/base/error.h"
#include "mechanics/elements/mesh_locator.h"
#include "process/scene/scene.h"
#include "process/setup/tool_meetings.h"
#include "process/state/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Whether no candidate face lies in front of a tool: it has the part on the wrong side, most
/// likely. Beyond the ends of an open surface there is no tool.
bool has_all_behind(const contact::Tool& tool,
                    const geometry::Pose& pose,
                    const contact::ContactSurface& surface,
                    std::span<const double> x,
                    double reach) {
  constexpr double touching = 0.02; // of the parent element
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (const Vec3& p : surface.samples(x, f, 1)) {
      const Vec3 at = pose.to_tool(p);
      geometry::Projection foot;
      tool.surface->project(std::span(&at, 1), reach, std::span(&foot, 1));
      if (foot.found() && foot.gap > touching * surface.depth(f))
        return false;
    }
  return true;
}

std::string turned(const contact::Tool& tool) {
  return "the whole workpiece lies inside of the tool, which may be turned" +
         (tool.facing.empty() ? "" : ": " + tool.facing);
}

/// How deep and where the workpiece's boundary lies inside a tool, if by more than chords of faces
/// do.
std::optional<std::string> depth_in(const Run& run, std::size_t tool, double time) {
  // A chord of a curved face may lie a little inside a tool that touches its nodes; a sharp tool
  // that was brought to the contact points of a face may lie deeper between them.
  const bool brought = tool < run.scene.touch.size() && run.scene.touch[tool] != 0;
  const double allowed_share = brought ? 0.5 : 0.02; // of the parent element
  const geometry::Pose pose = run.model.contact->pose(tool, time, run.state.x);
  double deepest = 0.0;
  Vec3 at = Vec3::Zero();
  for (Index f = 0; f < run.model.surface->n_faces(); ++f) {
    std::vector<Vec3> points = run.model.surface->samples(run.state.x, f);
    for (Vec3& p : points)
      p = pose.to_tool(p);
    std::vector<geometry::Projection> feet(points.size());
    run.tools()[tool].surface->project(points, body_size(run.mesh()), feet);
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (-feet[i].gap > std::max(deepest, allowed_share * run.model.surface->depth(f))) {
        deepest = -feet[i].gap;
        at = pose.to_space(points[i]);
      }
  }
  if (deepest > 0.0)
    return fmt::format("{:.6g} deep at ({:.6g}, {:.6g}, {:.6g})", deepest, at[0], at[1], at[2]);
  return std::nullopt;
}

/// Whether all places of a tool that are nearest to the workpiece's faces lie in the workpiece.
bool lies_within(const Run& run, std::size_t tool, double time) {
  const mechanics::MeshLocator locator(run.mesh(), run.positions());
  const geometry::Pose pose = run.model.contact->pose(tool, time, run.state.x);
  bool any = false;
  for (Index f = 0; f < run.model.surface->n_faces(); ++f)
    for (const Vec3& x : run.model.surface->samples(run.state.x, f, 1)) {
      const Vec3 at = pose.to_tool(x);
      geometry::Projection foot;
      run.tools()[tool].surface->project(std::span(&at, 1), body_size(run.mesh()),
                                         std::span(&foot, 1));
      if (!foot.found())
        continue;
      constexpr double clear = 0.02, inside = 1e-6; // of the parent element
      // A little within the tool's surface: one that touches a face has that outside.
      const double depth = run.model.surface->depth(f);
      const Vec3 within = pose.to_space(foot.foot - clear * depth * foot.normal);
      if (foot.gap < clear * depth || locator.locate(within).distance > inside * depth)
        return false;
      any = true;
    }
  return any;
}

} // namespace

std::optional<std::string> overlap(const Run& run, std::size_t tool, double time) {
  if (std::optional<std::string> where = depth_in(run, tool, time))
    return where;
  if (lies_within(run, tool, time))
    return "the tool lies wholly within it";
  return std::nullopt;
}

void check_overlap(const Run& run) {
  if (!run.model.contact)
    return;
  std::vector<Complaint> complaints;
  for (std::size_t t = 0; t < run.tools().size(); ++t)
    if (run.model.contact->acts(t, 0.0))
      if (const std::optional<std::string> where = overlap(run, t, run.state.time))
        complaints.push_back(
            {run.tools()[t].said_at,
             fmt::format("the workpiece overlaps tool '{}' before the start: {}",
                         run.tools()[t].name, *where),
             has_all_behind(run.tools()[t], run.model.contact->pose(t, run.state.time, run.state.x),
                            *run.model.surface, run.state.x, body_size(run.mesh()))
                 ? turned(run.tools()[t])
                 : "move the tool or the workpiece apart, or give the tool touch = true"});
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
}

std::vector<ToolMeeting> overlapping_tools(const Run& run) {
  std::vector<geometry::Pose> poses;
  for (std::size_t t = 0; run.model.contact && t < run.tools().size(); ++t)
    poses.push_back(run.model.contact->pose(t, run.state.time, run.state.x));
  return run.model.contact ? overlaps_by_loads(run.scene, run.state.time, poses)
                           : std::vector<ToolMeeting>{};
}

} // namespace billet::process
