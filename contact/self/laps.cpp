#include "contact/self/laps.h"

#include "contact/self/lap_depth.h"
#include "contact/self/wall_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace billet::contact {

namespace {

/// The points of a lap.
struct Marked {
  std::vector<Vec3> at;
  std::vector<double> areas; ///< that they stand for, of both walls [mm^2]
  bool closed = false;

  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (const double area : areas)
      sum += 0.5 * area;
    return sum;
  }
  [[nodiscard]] Vec3 centre() const {
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      sum += areas[i] * at[i];
      area += areas[i];
    }
    return sum / area;
  }
};

std::map<int, Marked>
marked(const ContactSurface& surface, const SelfContactState& state, std::span<const double> x) {
  std::map<int, Marked> found;
  if (state.laps_since.empty())
    return found;
  std::vector<Vec3> positions(surface.n_points());
  std::vector<double> areas(surface.n_points());
  surface.positions(x, positions);
  surface.areas(x, areas);
  for (std::size_t k = 0; k < state.points.size(); ++k)
    if (const SelfPoint& point = state.points[k]; point.lap >= 0) {
      Marked& lap = found[point.lap];
      lap.at.push_back(positions[k]);
      lap.areas.push_back(areas[k]);
      lap.closed = lap.closed || point.closed();
    }
  return found;
}

/// In the section: the length of a wall.
double depth_in_plane(const Marked& lap, bool axisymmetric) {
  double length = 0.0;
  for (std::size_t i = 0; i < lap.at.size(); ++i)
    length += 0.5 * lap.areas[i] /
              (axisymmetric ? 2.0 * std::numbers::pi * std::abs(lap.at[i].x()) : 1.0);
  return length;
}

/// Of each lap its depth [mm].
std::map<int, double> depths_of(const ContactSurface& surface,
                                const SelfContactState& state,
                                std::span<const double> x,
                                const std::map<int, Marked>& found) {
  std::map<int, double> depths;
  if (found.empty())
    return depths;
  if (surface.analysis() == mechanics::Analysis::solid) {
    const LapDepth depth(surface, state, x);
    for (const auto& [number, lap] : found)
      depths[number] = depth.of(number);
  } else
    for (const auto& [number, lap] : found)
      depths[number] = depth_in_plane(lap, surface.analysis() == mechanics::Analysis::axisymmetric);
  return depths;
}

} // namespace

void mark_laps(const ContactSurface& surface, SelfContactState& state) {
  if (std::none_of(state.points.begin(), state.points.end(),
                   [](const SelfPoint& point) { return point.closed(); }))
    return;
  const std::vector<Index> groups = wall_groups(surface, state);
  std::map<Index, std::vector<std::size_t>> places;
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k] >= 0)
      places[groups[k]].push_back(k);
  for (const auto& [group, members] : places) {
    std::vector<int> known;
    double since = HUGE_VAL;
    for (const std::size_t k : members) {
      since = std::min(since, state.points[k].since);
      if (state.points[k].lap >= 0)
        known.push_back(state.points[k].lap);
    }
    int lap = static_cast<int>(state.laps_since.size());
    if (known.empty())
      state.laps_since.push_back(since);
    else
      lap = *std::min_element(known.begin(), known.end());
    for (SelfPoint& point : state.points)
      if (std::find(known.begin(), known.end(), point.lap) != known.end())
        point.lap = lap;
    for (const std::size_t k : members)
      state.points[k].lap = lap;
  }
}

std::vector<Lap>
laps(const ContactSurface& surface, const SelfContactState& state, std::span<const double> x) {
  const std::map<int, Marked> all = marked(surface, state, x);
  const std::map<int, double> depths = depths_of(surface, state, x, all);
  std::vector<Lap> found;
  found.reserve(all.size());
  for (const auto& [number, lap] : all)
    found.push_back({lap.centre(), state.laps_since[static_cast<std::size_t>(number)],
                     depths.at(number), lap.area(), lap.closed});
  return found;
}

std::vector<double> lap_depths(const ContactSurface& surface,
                               const SelfContactState& state,
                               std::span<const double> x) {
  std::vector<double> at_points(state.points.size(), 0.0);
  const std::map<int, double> depths = depths_of(surface, state, x, marked(surface, state, x));
  for (std::size_t k = 0; k < at_points.size(); ++k)
    if (state.points[k].lap >= 0)
      at_points[k] = depths.at(state.points[k].lap);
  return at_points;
}

} // namespace billet::contact
