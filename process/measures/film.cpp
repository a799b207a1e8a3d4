#include "process/measures/film.h"

#include "geometry/base/box.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace billet::process {

namespace {

/// Share of the least extent of the part at the start.
constexpr double thin = 0.002;
/// Cosine between the normals of two tools below which they face each other.
constexpr double facing = -0.9;

double least_extent(const Run& run) {
  const mechanics::Mesh& mesh = run.scene.part.mesh;
  const Box box = box_of(mesh.points);
  double least = HUGE_VAL;
  for (Index d = 0; d < mesh.dimension(); ++d)
    least = std::min(least, box.high[d] - box.low[d]);
  return least;
}

/// A tool at the end of the last increment and at its beginning.
struct MovedTool {
  geometry::Pose now, before;

  MovedTool(const Run& run, std::size_t tool, double dt)
      : now(run.contact()->pose(tool, run.state.time, run.state.x)), before(now) {
    const double time = run.state.time - dt;
    std::vector<double> x = run.state.x;
    for (std::size_t i = 0; i < std::min(x.size(), run.state.last_step.size()); ++i)
      x[i] -= run.state.last_step[i];
    before = run.contact()->pose(tool, time, x);
  }
  /// Way of the material of the tool that is at a place now [mm].
  [[nodiscard]] Vec3 way(const Vec3& place) const {
    return place - before.to_space(now.to_tool(place));
  }
};

/// Points closed on a tool, in space, and the tool's normals there.
struct TouchingPoints {
  std::vector<Vec3> at, normals;
};

TouchingPoints touching(const Run& run, std::size_t tool, std::span<const Vec3> positions) {
  TouchingPoints points;
  const geometry::Pose pose = run.contact()->pose(tool, run.state.time, run.state.x);
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (contact::closed_on(*run.contact(), tool, k)) {
      points.at.push_back(positions[k]);
      points.normals.push_back(pose.rotation *
                               run.contact()->state().tools[tool].committed.history[k].normal);
    }
  return points;
}

} // namespace

std::optional<Film> closing_film(const Run& run, double dt) {
  if (run.contact() == nullptr || run.tools().size() < 2)
    return std::nullopt;
  const double film = thin * least_extent(run);
  const std::size_t n = run.tools().size();
  std::vector<Vec3> positions(run.model.surface->n_points());
  run.model.surface->positions(run.state.x, positions);
  std::optional<Film> thinnest;
  for (std::size_t first = 0; first < n; ++first) {
    const TouchingPoints points = touching(run, first, positions);
    if (points.at.empty())
      continue;
    const MovedTool one(run, first, dt);
    for (std::size_t second = 0; second < n; ++second) {
      if (second == first || !run.contact()->acts(second, run.state.time))
        continue;
      const MovedTool other(run, second, dt);
      std::vector<Vec3> local;
      for (const Vec3& at : points.at)
        local.push_back(other.now.to_tool(at));
      std::vector<geometry::Projection> feet(local.size());
      run.tools()[second].surface->project(local, film, feet);
      for (std::size_t i = 0; i < feet.size(); ++i) {
        if (!feet[i].found() || (thinnest && feet[i].gap >= thinnest->thickness))
          continue;
        const Vec3 normal = other.now.rotation * feet[i].normal;
        if (normal.dot(points.normals[i]) < facing &&
            (one.way(points.at[i]) - other.way(points.at[i])).dot(normal) < 0.0)
          thinnest = Film{first, second, points.at[i], feet[i].gap};
      }
    }
  }
  return thinnest;
}

} // namespace billet::process
