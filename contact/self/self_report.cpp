#include "contact/self/self_report.h"

#include "contact/self/wall_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace billet::contact {

std::vector<MeetingWalls> meeting_walls(const ContactSurface& surface,
                                        const SelfContactState& state,
                                        std::span<const double> x) {
  const std::vector<Index> groups = wall_groups(surface, state);
  std::vector<Vec3> positions(surface.n_points());
  std::vector<double> areas(surface.n_points());
  surface.positions(x, positions);
  surface.areas(x, areas);
  std::map<Index, MeetingWalls> walls;
  std::map<Index, double> force;
  for (std::size_t k = 0; k < state.points.size(); ++k) {
    const SelfPoint& point = state.points[k];
    if (!point.closed())
      continue;
    const Index group = groups[k];
    const auto [entry, is_new] = walls.try_emplace(group);
    MeetingWalls& wall = entry->second;
    const double area = 0.5 * areas[k]; // each wall is half of what touches
    const double turn = surface.analysis() == mechanics::Analysis::axisymmetric
                            ? 2.0 * std::numbers::pi * positions[k].x()
                            : 1.0;
    wall.since = is_new ? point.since : std::min(wall.since, point.since);
    wall.place += area * positions[k];
    wall.area += area;
    if (surface.analysis() != mechanics::Analysis::solid)
      wall.length += area / turn;
    force[group] += area * point.history.pressure;
  }
  std::vector<MeetingWalls> found;
  for (auto& [group, wall] : walls) {
    wall.place /= wall.area;
    wall.mean_pressure = force[group] / wall.area;
    found.push_back(wall);
  }
  return found;
}

void add_self_contact(const SelfContactState& state, std::span<PointResult> results) {
  for (std::size_t k = 0; k < state.points.size(); ++k) {
    const SelfPoint& point = state.points[k];
    PointResult& result = results[k];
    result.sliding += point.history.sliding;
    if (!point.closed())
      continue;
    result.gap = std::min(result.gap, point.offset.z());
    result.pressure += point.history.pressure;
    result.shear += point.history.shear;
    result.status = std::max(result.status, point.history.status());
  }
}

} // namespace billet::contact
