// Parts that will buckle and tools that nothing comes to.

#include "geometry/base/box.h"
#include "io/advice/advice_parts.h"
#include "io/advice/part_ends.h"
#include "io/advice/tool_samples.h"
#include "process/setup/tool_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::io {

namespace {

using process::Scene;

/// Share of the nodes of the pressed end that lie in the pressing tools when these are deepest.
double pressed_share(const Scene& scene, const NominalFlow& flow) {
  double most = 0.0;
  for (const End end : {End::low, End::high}) {
    std::vector<Vec3> points;
    for (const mechanics::Index node : nodes_at(scene.part, flow.axis, end))
      points.push_back(scene.part.mesh.points[idx(node)]);
    std::size_t in = 0;
    for (const std::size_t t : flow.pressing) {
      const std::vector<double> gaps =
          gaps_of(scene.tools[t], flow.deepest, points, 10.0 * process::body_size(scene.part.mesh));
      in = std::max(in, static_cast<std::size_t>(std::count_if(
                            gaps.begin(), gaps.end(), [](double gap) { return gap < 0.0; })));
    }
    if (!points.empty())
      most = std::max(most, static_cast<double>(in) / static_cast<double>(points.size()));
  }
  return most;
}

/// Whether a tool stands so near to the sides that it guides them.
bool is_guided(const Scene& scene, const NominalFlow& flow) {
  constexpr double near = 0.15, few = 0.2; // of the width; of the nodes
  const Box box = box_of(scene.part.mesh.points);
  std::vector<Vec3> sides; // nodes between the ends
  for (const Vec3& x : contact_nodes(scene, 1000))
    if (std::abs(x[flow.axis] - box.low[flow.axis]) > 0.1 * flow.height &&
        std::abs(x[flow.axis] - box.high[flow.axis]) > 0.1 * flow.height)
      sides.push_back(x);
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (std::find(flow.pressing.begin(), flow.pressing.end(), t) != flow.pressing.end())
      continue;
    const std::vector<double> gaps =
        gaps_of(scene.tools[t], 0.0, sides, process::body_size(scene.part.mesh));
    const auto beside = std::count_if(gaps.begin(), gaps.end(),
                                      [&](double gap) { return gap < near * flow.width; });
    if (static_cast<double>(beside) > few * static_cast<double>(sides.size()))
      return true;
  }
  return false;
}

/// A tool that no stage and no time lets act.
std::optional<std::string> never_acts(const Scene& scene, std::size_t t) {
  const std::vector<Look> looks = looks_at(scene);
  if (std::any_of(looks.begin(), looks.end(),
                  [&](const Look& look) { return look.acts(scene, t); }))
    return std::nullopt;
  const bool is_in_stage =
      std::any_of(scene.stages.begin(), scene.stages.end(), [&](const process::Stage& stage) {
        return !stage.unload && stage.tools[t] != 0;
      });
  return fmt::format(
      "tool '{}' acts in no part of the run ({}): it can be left out", scene.tools[t].name,
      is_in_stage ? "its active times lie outside of its stages" : "no stage names it");
}

using ReachesOfTools = std::vector<std::optional<process::ToolReach>>;

/// How far supports and tools may bring the part or any of it [mm]; none: a load does.
std::optional<double> way_of_all(const Scene& scene, const ReachesOfTools& reaches) {
  const bool is_driven =
      !scene.part.loads.empty() ||
      std::any_of(scene.tools.begin(), scene.tools.end(), [](const contact::Tool& tool) {
        return tool.motion.force || tool.motion.torque;
      });
  if (is_driven)
    return std::nullopt;
  double ways = 0.0;
  for (const process::Support& support : scene.part.supports)
    for (const auto& [time, moved] : support.displacement.points())
      ways = std::max(ways, std::abs(moved));
  for (const std::optional<process::ToolReach>& reach : reaches)
    ways += reach ? reach->way : 0.0;
  return ways;
}

/// A tool that rests, so far off that no motion of the others brings the part there.
std::optional<std::string> is_out_of_reach(const Scene& scene,
                                           std::size_t t,
                                           const ReachesOfTools& reaches,
                                           const UnitSystem& units) {
  constexpr double far = 3.0; // of the part's size plus all ways
  const std::optional<process::ToolReach>& reach = reaches[t];
  const std::optional<double> ways = way_of_all(scene, reaches);
  if (!reach || !ways || reach->way > 0.0 || reach->has_all_behind)
    return std::nullopt;
  const double near = process::body_size(scene.part.mesh) + *ways;
  if (reach->least.gap <= far * near)
    return std::nullopt;
  return fmt::format("tool '{}' rests {:.3g} {} off the workpiece, {:.2g} times its size and all "
                     "ways of the other tools: it is never reached and can be left out",
                     scene.tools[t].name, reach->least.gap, units.length, reach->least.gap / near);
}

} // namespace

std::vector<Advice> tool_advice(const Case& content, const Scene& scene) {
  ReachesOfTools reaches;
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    reaches.push_back(process::tool_reach(scene, t));
  std::vector<Advice> all;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    std::optional<std::string> text = never_acts(scene, t);
    if (!text)
      text = is_out_of_reach(scene, t, reaches, content.units);
    if (text)
      all.push_back({Advice::Kind::idle_tool, *text});
  }
  return all;
}

std::optional<Advice>
buckling_advice(const Case& content, const Scene& scene, const NominalFlow& flow) {
  // "Not more than three times the diameter of the bar" for one blow (Forging Industry Association,
  // design rules for upset forgings, rule 1); shops stay below 2.3 to 2.5.
  constexpr double most_of_bar = 2.5, least_strain = 0.05, mostly = 0.5;
  constexpr double most_of_wall = 4.0; // bulges outward and inward at first
  if (!flow.compresses || flow.strain < least_strain || !std::isfinite(flow.width))
    return std::nullopt;
  const Box box = box_of(scene.part.mesh.points);
  const bool is_wall =
      scene.part.analysis == mechanics::Analysis::axisymmetric && box.low[0] > 1e-6 * box.size();
  const double ratio = flow.height / flow.width;
  if (ratio <= (is_wall ? most_of_wall : most_of_bar) || is_guided(scene, flow) ||
      (!flow.pressing.empty() && pressed_share(scene, flow) < mostly))
    return std::nullopt;
  const bool is_half =
      is_mirror(scene.part, flow.axis, End::low) || is_mirror(scene.part, flow.axis, End::high);
  return Advice{
      Advice::Kind::buckling,
      fmt::format(
          "{} {:.3g} {} high and {:.3g} {} {} is upset by {:.0f} %: at {:.2g} times its "
          "{}{} it buckles or folds (bars stay straight to 2.5){}{}",
          is_wall ? "a wall" : "a part", flow.height, content.units.length, flow.width,
          content.units.length, is_wall ? "thick" : "wide", 100.0 * (1.0 - std::exp(-flow.strain)),
          ratio, is_wall ? "thickness" : "width", is_half ? ", twice that if it is a half," : "",
          content.analysis == Analysis::axisymmetric && !is_wall
              ? ", which an axisymmetric scene does not show"
              : "",
          content.contact.self.on ? "" : ", and contact.self = false: it does not feel itself")};
}

} // namespace billet::io
