// Slips of motions and supports: told from the scene, before anything is solved.

#include "geometry/base/box.h"
#include "io/case/initial_yield.h"
#include "io/slips/scene_slips.h"
#include "io/slips/slip.h"
#include "process/setup/tool_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

namespace billet::io {

namespace {

using process::Scene;
using process::ToolReach;
using Reaches = std::vector<std::optional<ToolReach>>;

/// A scene with what the slips of motions ask of it.
struct MotionScene {
  const Case& content;
  const Scene& scene;
  Reaches reaches;
  double size;   ///< of the part [mm]
  double closed; ///< a gap that counts as none [mm]
};

MotionScene motion_scene(const Case& content, const Scene& scene) {
  constexpr double closed_share = 1e-4; // as process/tool_reach has it
  const double size = process::body_size(scene.part.mesh);
  MotionScene motions{content, scene, {}, size, closed_share * size};
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    motions.reaches.push_back(process::tool_reach(scene, t));
  return motions;
}

bool is_driven(const contact::Tool& tool) { return tool.motion.force || tool.motion.torque; }

/// Largest change of a function over its points.
double range(const TimeFunction& function) {
  const auto& points = function.points();
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; });
  return high->second - low->second;
}

/// How far others may bring the part, or stretch it, towards a tool [mm].
double brought_by_others(const MotionScene& m, std::size_t tool) {
  double way = 0.0;
  bool any = !m.scene.part.loads.empty();
  for (const process::Support& support : m.scene.part.supports)
    any = any || range(support.displacement) != 0.0;
  for (std::size_t t = 0; t < m.reaches.size(); ++t) {
    if (t == tool)
      continue;
    if (is_driven(m.scene.tools[t]))
      return std::numeric_limits<double>::infinity();
    if (m.reaches[t] && m.reaches[t]->touches && m.reaches[t]->way > 0.0) {
      any = true;
      way += m.reaches[t]->way;
    }
  }
  return any ? way + m.size : 0.0;
}

/// A tool that moves and never comes to the part.
Slip never_arrives(const MotionScene& m, std::size_t t) {
  const std::optional<ToolReach>& reach = m.reaches[t];
  if (!reach || reach->way == 0.0 || reach->has_all_behind)
    return std::nullopt;
  const UnitSystem& units = m.content.units;
  const std::string& name = m.scene.tools[t].name;
  const double brought = brought_by_others(m, t);
  const bool leaves = reach->draws_back && reach->last.gap > reach->first.gap + m.closed &&
                      reach->least.gap >= reach->first.gap - m.closed;
  const bool only_lifts = reach->touches && reach->least.gap > -m.closed; // not once in the part
  if (leaves && brought == 0.0 && (only_lifts || !reach->touches))
    return fmt::format("tool '{}' moves away from the workpiece: it is {:.3g} {} off at t = {:.6g} "
                       "{} and {:.3g} {} at t = {:.6g} {}; reverse its motion",
                       name, std::max(reach->first.gap, 0.0), units.length, reach->first.time,
                       units.time, reach->last.gap, units.length, reach->last.time, units.time);
  if (reach->touches || reach->least.gap <= brought)
    return std::nullopt;
  return fmt::format(
      "tool '{}' does not reach the workpiece: it is {:.3g} {} off at t = {:.6g} {}, "
      "moves {:.3g} {} and comes as near as {:.3g} {}; touch = true brings it to the "
      "workpiece before the start, or let it move farther",
      name, reach->first.gap, units.length, reach->first.time, units.time, reach->way, units.length,
      reach->least.gap, units.length);
}

/// A tool that has a long way through the air: perhaps the part is elsewhere, or of another size.
Slip starts_far_off(const MotionScene& m, std::size_t t) {
  constexpr double far = 3.0; // sizes of the part
  const std::optional<ToolReach>& reach = m.reaches[t];
  if (!reach || !reach->touches || reach->has_all_behind ||
      reach->first.gap <= far * m.size + brought_by_others(m, t))
    return std::nullopt;
  return fmt::format("tool '{}' is {:.3g} {} off the workpiece when it begins to act, {:.3g} times "
                     "the size of that ({:.3g} {}): is it meant to? touch = true brings it there "
                     "before the start",
                     m.scene.tools[t].name, reach->first.gap, m.content.units.length,
                     reach->first.gap / m.size, m.size, m.content.units.length);
}

/// A tool that has the part behind its surface, so far that it is no overlap.
Slip turned_tool(const MotionScene& m, std::size_t t) {
  if (!m.reaches[t] || !m.reaches[t]->has_all_behind)
    return std::nullopt;
  return fmt::format("tool '{}': the whole workpiece lies behind its surface, up to {:.3g} {} "
                     "deep: {}",
                     m.scene.tools[t].name, -m.reaches[t]->first.gap, m.content.units.length,
                     m.scene.tools[t].facing);
}

/// A tool pushes where nothing holds.
Slip pushed_away(const MotionScene& m) {
  const std::optional<process::LonelyPush> push = process::lonely_push(m.scene, m.reaches);
  if (!push)
    return std::nullopt;
  const Box box = box_of(m.scene.part.mesh.points);
  const char axis = "xyz"[push->axis];
  const double level = push->sign > 0.0 ? box.high[push->axis] : box.low[push->axis];
  return fmt::format("tool '{}' pushes the workpiece along {}{}, and neither a support nor another "
                     "tool holds it: it is carried away without a force; add a [[support]] with "
                     "where = \"{} = {:g}\" and fix = [\"{}\"] if that is a plane of symmetry or a "
                     "face that is held, or a tool on that side",
                     m.scene.tools[push->tool].name, push->sign > 0.0 ? "" : "-", axis, axis, level,
                     axis);
}

/// Whether all of some nodes have a support in a component.
bool are_held(const Scene& scene, std::span<const mechanics::Index> nodes, int component) {
  std::vector<char> held(scene.part.mesh.points.size(), 0);
  for (const process::Support& support : scene.part.supports)
    if (support.component == component)
      for (const mechanics::Index node : support.nodes)
        held[idx(node)] = 1;
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](mechanics::Index node) { return held[idx(node)] != 0; });
}

/// The axis of revolution stays where it is.
Slip free_axis(const MotionScene& m) {
  if (m.content.analysis != Analysis::axisymmetric)
    return std::nullopt;
  std::vector<mechanics::Index> axis;
  for (mechanics::Index node = 0; node < m.scene.part.mesh.n_points(); ++node)
    if (m.scene.part.mesh.points[idx(node)][0] == 0.0)
      axis.push_back(node);
  if (are_held(m.scene, axis, 0))
    return std::nullopt;
  return "the workpiece lies on the axis of revolution, which nothing holds in x: add a "
         "[[support]] "
         "with where = \"x = 0\" and fix = [\"x\"]";
}

/// The cuts of a sector are planes of symmetry.
Slip free_cut(const MotionScene& m) {
  const auto* const cylinder = std::get_if<CylinderMesh>(&m.content.workpiece.mesh);
  if (cylinder == nullptr || m.content.workpiece.place.rotate)
    return std::nullopt;
  for (const auto& [set, component] : {std::pair("x-min", 0), std::pair("y-min", 1)}) {
    const auto nodes = m.scene.part.mesh.node_sets.find(set);
    if (nodes == m.scene.part.mesh.node_sets.end() || are_held(m.scene, nodes->second, component))
      continue;
    const char axis = "xyz"[component];
    return fmt::format("a sector of {} degrees stands for a whole cylinder only if its cuts are "
                       "planes of symmetry: add a [[support]] with where = \"set:{}\" and "
                       "fix = [\"{}\"]",
                       cylinder->sector, set, axis);
  }
  return std::nullopt;
}

/// Strain that tools and supports make at most, of the part as a whole under planes, of an element
/// elsewhere; none where nobody knows.
std::optional<double> most_strain(const MotionScene& m, const contact::ContactSurface* surface) {
  const Box box = box_of(m.scene.part.mesh.points);
  const Vec3 extent = box.high - box.low;
  if (!m.scene.part.loads.empty())
    return std::nullopt;
  double strain = 0.0;
  for (const process::Support& support : m.scene.part.supports)
    strain += range(support.displacement) / extent[support.component];
  double element = std::numeric_limits<double>::infinity();
  for (mechanics::Index f = 0; surface != nullptr && f < surface->n_faces(); ++f)
    element = std::min(element, surface->depth(f));
  for (std::size_t t = 0; t < m.reaches.size(); ++t) {
    const geometry::Motion& motion = m.scene.tools[t].motion;
    if (is_driven(m.scene.tools[t]) || motion.rotation)
      return std::nullopt;
    if (!m.reaches[t])
      continue;
    const double depth = std::max(0.0, m.reaches[t]->way - std::max(0.0, m.reaches[t]->first.gap));
    const auto* const plane = std::get_if<PlaneSurface>(&m.content.tools[t].surface);
    const double height =
        plane != nullptr
            ? extent.dot((motion.place.rotation * plane->normal).normalized().cwiseAbs())
            : element;
    strain += depth / height;
  }
  return strain;
}

/// A run that ends before the metal flows.
Slip nothing_yields(const MotionScene& m, const contact::ContactSurface* surface) {
  constexpr double concentration = 3.0; // of strain at an edge
  const std::optional<double> strain = most_strain(m, surface);
  if (!strain)
    return std::nullopt;
  if (*strain == 0.0)
    return "nothing moves or loads the workpiece: give a tool a motion, or a support a move";
  const Material& material = m.content.materials.at(m.content.workpiece.material);
  const double yield = material.flow ? initial_yield(*material.flow) : 0.0;
  if (concentration * *strain * material.elastic.young >= yield)
    return std::nullopt;
  return fmt::format("until the end, t = {:g} {}, the workpiece is strained by about {:.2g}, and "
                     "metal yields at {:.2g}: nothing will flow; is the end too early, or a motion "
                     "too slow?",
                     m.content.time.end, m.content.units.time, *strain,
                     yield / material.elastic.young);
}

} // namespace

std::vector<std::string> motion_slips(const Case& content, const process::Run& run) {
  const MotionScene m = motion_scene(content, run.scene);
  std::vector<std::string> slips;
  for (std::size_t t = 0; t < m.reaches.size(); ++t) {
    add_slip(slips, "tool-behind", turned_tool(m, t));
    add_slip(slips, "tool-misses", never_arrives(m, t));
  }
  const bool all_arrive = slips.empty();
  for (std::size_t t = 0; t < m.reaches.size(); ++t)
    add_slip(slips, "tool-far", starts_far_off(m, t));
  if (all_arrive) {
    add_slip(slips, "part-pushed-away", pushed_away(m));
    add_slip(slips, "nothing-yields", nothing_yields(m, run.model.surface.get()));
  }
  add_slip(slips, "free-axis", free_axis(m));
  add_slip(slips, "free-cut", free_cut(m));
  return slips;
}

} // namespace billet::io
