#include "process/setup/tool_reach.h"

#include "geometry/base/box.h"
#include "geometry/collision/facet_body.h"
#include "process/setup/touch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

constexpr int looks_a_stage = 24;
constexpr double touch_share = 1e-4; // of the part's size: what counts as touching

bool acts_in(const Stage& stage, const contact::Tool& tool, std::size_t number, double time) {
  return !stage.unload && stage.tools[number] != 0 && tool.active(time);
}

/// Times at which a tool is looked at: of every stage in which it acts both ends, the corners of
/// all that is given over time, and steps between them.
std::vector<double> times_of(const Scene& scene, std::size_t number) {
  const contact::Tool& tool = scene.tools[number];
  std::vector<double> times;
  double start = 0.0;
  for (const Stage& stage : scene.stages) {
    const double from = std::max(start, tool.active_from);
    const double to = std::min(stage.end, tool.active_to);
    for (int k = 0; k <= looks_a_stage && from <= to; ++k)
      if (const double time = from + (to - from) * k / looks_a_stage;
          acts_in(stage, tool, number, time))
        times.push_back(time);
    for (const double time : scene.landing_times)
      if (time > from && time < to && acts_in(stage, tool, number, time))
        times.push_back(time);
    start = stage.end;
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// The faces of the workpiece that may touch, as they lie at the start: nodes, and facets.
struct Faces {
  std::vector<Vec3> points;
  geometry::DisplayMesh facets;
};

Faces faces_of(const Scene& scene) {
  Faces faces;
  std::vector<std::int32_t> number(scene.part.mesh.points.size(), -1);
  const auto numbered = [&](Index node) {
    std::int32_t& at = number[idx(node)];
    if (at < 0) {
      at = static_cast<std::int32_t>(faces.points.size());
      faces.points.push_back(scene.part.mesh.points[idx(node)]);
    }
    return at;
  };
  for (const mechanics::Face& face : scene.part.contact_faces) {
    std::vector<std::int32_t> nodes;
    for (const Index node : face.nodes)
      nodes.push_back(numbered(node));
    const bool quadrilateral = nodes.size() == 4 || nodes.size() == 8;
    if (scene.part.mesh.dimension() == 2)
      faces.facets.lines.push_back({nodes[0], nodes[1]});
    else
      faces.facets.triangles.push_back({nodes[0], nodes[1], nodes[2]});
    if (scene.part.mesh.dimension() == 3 && quadrilateral)
      faces.facets.triangles.push_back({nodes[0], nodes[2], nodes[3]});
  }
  faces.facets.points = faces.points;
  return faces;
}

/// One tool on its way past the workpiece as that lies at the start.
class WayPast {
public:
  WayPast(const Scene& scene, std::size_t tool, const Faces& faces)
      : planar_(scene.part.analysis != mechanics::Analysis::solid), tool_(scene.tools[tool]),
        faces_(faces), size_(body_size(scene.part.mesh)) {}

  /// The closest places of its surface for all nodes, as far as any are looked for; normals in
  /// space.
  [[nodiscard]] std::vector<geometry::Projection> feet(double time) const {
    const geometry::Pose pose = tool_.motion.pose(time);
    std::vector<Vec3> places;
    for (const Vec3& p : faces_.points)
      places.push_back(pose.to_tool(p));
    std::vector<geometry::Projection> found(places.size());
    tool_.surface->project(places, farthest(), found);
    for (geometry::Projection& foot : found)
      foot.normal = pose.rotation * foot.normal;
    return found;
  }

  /// Smallest gap of the nodes; the farthest that is looked for if all are farther.
  [[nodiscard]] double gap(double time) const {
    double least = farthest();
    for (const geometry::Projection& foot : feet(time))
      least = std::min(least, foot.gap);
    return least;
  }

  /// Whether nodes lie behind its surface and none before it.
  [[nodiscard]] bool has_all_behind(double time) const {
    bool any = false;
    for (const geometry::Projection& foot : feet(time)) {
      if (foot.found() && foot.gap > -touch_share * size_)
        return false;
      any = any || foot.found();
    }
    return any;
  }

  /// Whether a shift takes the tool away from all the nodes that are nearest to it.
  [[nodiscard]] bool draws_back(double time, const Vec3& shift) const {
    constexpr double near = 0.02; // of the part's size
    constexpr double hardly = 1e-3;
    const std::vector<geometry::Projection> all = feet(time);
    const double least = gap(time);
    return std::all_of(all.begin(), all.end(), [&](const geometry::Projection& foot) {
      return !foot.found() || foot.gap > least + near * size_ ||
             foot.normal.dot(shift) < -hardly * shift.norm();
    });
  }

  /// Distances of facets at these times: a narrow tool comes down between nodes.
  ///
  /// @param farthest_node  the least gap of the nodes [mm]
  [[nodiscard]] std::vector<double> gaps_of_facets(std::span<const double> times,
                                                   double farthest_node) const {
    Box window;
    for (const double time : times)
      for (const Vec3& p : faces_.points)
        window.add(tool_.motion.pose(time).to_tool(p));
    window.low.array() -= farthest_node;
    window.high.array() += farthest_node;
    if (!std::isfinite(window.size()))
      return std::vector<double>(times.size(), std::numeric_limits<double>::infinity());
    const geometry::FacetBody tool(tool_.surface->display(window, planar_), window.size());
    const geometry::FacetBody workpiece(faces_.facets, window.size());
    std::vector<double> gaps;
    for (const double time : times)
      gaps.push_back(geometry::clearance({tool, tool_.motion.pose(time)}, {workpiece, {}}));
    return gaps;
  }

  /// Way of any point of the tool that is no farther from its axis than the workpiece is [mm].
  [[nodiscard]] double way(double from, double to) const {
    const geometry::Motion& motion = tool_.motion;
    const double turned = std::abs(motion.angle(to) - motion.angle(from));
    double arm = 0.0;
    for (std::size_t k = 0; turned > 0.0 && k < faces_.points.size(); ++k) {
      const Vec3 lever = faces_.points[k] - motion.axis_point() - motion.translation(from);
      arm = std::max(arm, lever.cross(motion.axis()).norm());
    }
    return (motion.translation(to) - motion.translation(from)).norm() + turned * arm;
  }

  /// A gap that counts as none [mm].
  [[nodiscard]] double closed() const { return touch_share * size_; }

private:
  [[nodiscard]] double farthest() const { return most_sizes_to_touch * size_; }

  bool planar_;
  const contact::Tool& tool_;
  const Faces& faces_;
  double size_;
};

void take(ToolReach& reach, const ToolGap& seen) {
  if (seen.time == reach.first.time)
    reach.first.gap = std::min(reach.first.gap, seen.gap);
  if (seen.time == reach.last.time)
    reach.last.gap = std::min(reach.last.gap, seen.gap);
  if (seen.gap < reach.least.gap)
    reach.least = seen;
}

/// A component of the direction into which a tool begins to move, or is driven; 0: none.
double direction_along(const contact::Tool& tool,
                       const std::optional<ToolReach>& reach,
                       double end,
                       int axis) {
  if (reach)
    return reach->way > 0.0 && reach->shift.norm() > 0.0 ? reach->shift.normalized()[axis] : 0.0;
  if (!tool.motion.force)
    return 0.0;
  const double load = tool.motion.force->blow ? 1.0 : tool.motion.force->load.integral(end);
  return load == 0.0 ? 0.0 : std::copysign(1.0, load) * tool.motion.force->axis[axis];
}

/// Whether the tool's surface faces into a direction where it is nearest to the workpiece.
bool faces_along(std::span<const geometry::Projection> feet, double near, int axis, double sign) {
  constexpr double mostly = 0.5;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::Projection& foot : feet)
    least = std::min(least, foot.gap);
  return std::any_of(feet.begin(), feet.end(), [&](const geometry::Projection& foot) {
    return foot.found() && foot.gap <= least + near && sign * foot.normal[axis] > mostly;
  });
}

/// Whether anything of the tool's surface could stop what moves into a direction.
bool stops(std::span<const geometry::Projection> feet, int axis, double sign) {
  constexpr double hardly = -0.05;
  return std::any_of(feet.begin(), feet.end(), [&](const geometry::Projection& foot) {
    return foot.found() && sign * foot.normal[axis] < hardly;
  });
}

} // namespace

std::optional<ToolReach> tool_reach(const Scene& scene, std::size_t number) {
  const contact::Tool& tool = scene.tools[number];
  const std::vector<double> times = times_of(scene, number);
  if (times.empty() || tool.motion.force || tool.motion.torque)
    return std::nullopt;
  const Faces faces = faces_of(scene);
  const WayPast past(scene, number, faces);
  constexpr double far = std::numeric_limits<double>::infinity();
  ToolReach reach{{times.front(), far}, {times.back(), far}, {times.front(), far}};
  double longest = 0.0; // way between two looks
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double way = past.way(times[k - 1], times[k]);
    longest = std::max(longest, way);
    reach.way += way;
  }
  reach.shift = tool.motion.translation(times.back()) - tool.motion.translation(times.front());
  for (const double time : {times.front(), times.back()})
    take(reach, {time, past.gap(time)});
  for (std::size_t k = 0; k < times.size() && reach.way > 0.0; ++k)
    if (reach.least.gap > -past.closed()) // else it is in the part, which is all there is to know
      take(reach, {times[k], past.gap(times[k])});
  reach.draws_back = past.draws_back(times.front(), reach.shift);
  reach.has_all_behind = times.front() <= 0.0 && past.has_all_behind(times.front());
  if (reach.least.gap > past.closed()) {
    const std::vector<double> gaps = past.gaps_of_facets(times, reach.least.gap);
    for (std::size_t k = 0; k < times.size(); ++k)
      take(reach, {times[k], gaps[k]});
  }
  reach.touches = reach.least.gap <= std::max(past.closed(), 0.5 * longest);
  return reach;
}

std::optional<LonelyPush> lonely_push(const Scene& scene,
                                      std::span<const std::optional<ToolReach>> reaches) {
  constexpr double near = 0.02; // of the part's size
  if (!scene.part.loads.empty())
    return std::nullopt;
  const Faces faces = faces_of(scene);
  std::vector<std::vector<geometry::Projection>> feet(scene.tools.size());
  for (std::size_t t = 0; t < feet.size(); ++t)
    if (const std::vector<double> times = times_of(scene, t); !times.empty())
      feet[t] = WayPast(scene, t, faces).feet(times.front());
  const FreeMotions free = free_motions(scene.part);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t t = 0; free.along[idx(axis)] && t < feet.size(); ++t) {
      const double along =
          direction_along(scene.tools[t], reaches[t], scene.stages.back().end, axis);
      constexpr double mostly = 0.5;
      const double sign = std::copysign(1.0, along);
      if (std::abs(along) < mostly || (reaches[t] && !reaches[t]->touches) ||
          !faces_along(feet[t], near * body_size(scene.part.mesh), axis, sign))
        continue;
      bool is_held = false;
      for (std::size_t other = 0; other < feet.size() && !is_held; ++other) {
        const bool rubs =
            !std::holds_alternative<contact::Frictionless>(scene.tools[other].friction.law);
        is_held = stops(feet[other], axis, sign) || (other != t && rubs && !feet[other].empty());
      }
      if (!is_held)
        return LonelyPush{t, axis, sign};
    }
  return std::nullopt;
}

} // namespace billet::process
