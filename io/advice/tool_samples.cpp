#include "io/advice/tool_samples.h"

#include "geometry/base/box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace billet::io {

std::vector<Look> looks_at(const process::Scene& scene) {
  constexpr int looks_a_stage = 48;
  std::vector<Look> looks;
  double start = 0.0;
  for (const process::Stage& stage : scene.stages) {
    for (int k = 0; k < looks_a_stage; ++k)
      looks.push_back({start + (stage.end - start) * k / looks_a_stage, &stage});
    looks.push_back({stage.end, &stage}); // not a rounding after it, when the next stage has begun
    for (const double time : scene.landing_times)
      if (time > start && time < stage.end)
        looks.push_back({time, &stage});
    start = stage.end;
  }
  std::stable_sort(looks.begin(), looks.end(),
                   [](const Look& a, const Look& b) { return a.time < b.time; });
  return looks;
}

std::vector<double> four_times(const process::Scene& scene) {
  const double end = scene.stages.back().end;
  return {0.0, end / 3.0, 2.0 * end / 3.0, end};
}

std::vector<double>
gaps_of(const contact::Tool& tool, double time, std::span<const Vec3> points, double reach) {
  const geometry::Pose pose = tool.motion.pose(time);
  std::vector<Vec3> places;
  for (const Vec3& x : points)
    places.push_back(pose.to_tool(x));
  std::vector<geometry::Projection> feet(places.size());
  tool.surface->project(places, reach, feet);
  std::vector<double> gaps;
  gaps.reserve(feet.size());
  for (const geometry::Projection& foot : feet)
    gaps.push_back(foot.gap);
  return gaps;
}

bool are_same_gaps(std::span<const double> a,
                   std::span<const double> b,
                   double reach,
                   double tolerance) {
  const auto is_far = [&](double gap) { return std::abs(gap) >= reach - tolerance; };
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(is_far(a[i]) && is_far(b[i])) && !(std::abs(a[i] - b[i]) <= tolerance))
      return false;
  return true;
}

std::optional<double> shape_tolerance(const process::Scene& scene) {
  constexpr double rounding = 1e-5, coarse = 1e-3; // of the part's size
  const double size = process::body_size(scene.part.mesh);
  double chord_error = 0.0;
  for (const contact::Tool& tool : scene.tools)
    chord_error = std::max(chord_error, tool.chord_error);
  if (chord_error > coarse * size)
    return std::nullopt;
  return rounding * size + 2.0 * chord_error;
}

std::vector<Vec3> grid_about(const process::Scene& scene, int steps) {
  constexpr double margin = 0.25;
  const Box box = box_of(scene.part.mesh.points);
  const Vec3 extent = box.high - box.low;
  const int layers = scene.part.mesh.dimension() == 3 ? steps : 1;
  // Steps of unequal length: a regular grid would fit regular shapes too well.
  const auto at = [&](int axis, int k) {
    const double share = (k + 0.3 * std::sin(7.0 * k + axis)) / (steps - 1);
    return box.low[axis] + extent[axis] * (-margin + (1.0 + 2.0 * margin) * share);
  };
  std::vector<Vec3> points;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (int k = 0; k < layers; ++k)
        points.emplace_back(at(0, i), at(1, j), layers > 1 ? at(2, k) : 0.0);
  return points;
}

std::vector<Vec3> contact_nodes(const process::Scene& scene, std::size_t most) {
  std::set<mechanics::Index> nodes;
  for (const mechanics::Face& face : scene.part.contact_faces)
    nodes.insert(face.nodes.begin(), face.nodes.end());
  const std::size_t every = nodes.size() / most + 1;
  std::vector<Vec3> points;
  std::size_t k = 0;
  for (const mechanics::Index node : nodes)
    if (k++ % every == 0)
      points.push_back(scene.part.mesh.points[idx(node)]);
  return points;
}

} // namespace billet::io
