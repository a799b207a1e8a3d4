#include "process/remeshing/first_touch.h"

#include "process/remeshing/contact_zones.h"
#include "process/remeshing/part_boundary.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/remeshing_due.h"
#include "process/remeshing/sizes.h"
#include "process/state/run.h"
#include "process/state/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::process {

namespace {

/// Places on a side at which the gap is looked at: the middles of as many parts of it. Its ends may
/// lie on the rim of a tool that ends on the axis.
constexpr std::size_t places_on_side = 16;

/// How deep in a tool they are seen, in mean sides.
constexpr double reach = 4.0;

std::array<Vec3, places_on_side> places_on(const geometry::SideLoop& loop, std::size_t side) {
  std::array<Vec3, places_on_side> places;
  const Vec2& start = loop.corners[side];
  const Vec2& end = loop.corners[(side + 1) % loop.corners.size()];
  for (std::size_t i = 0; i < places_on_side; ++i) {
    const double xi = (2.0 * static_cast<double>(i) + 1.0) / places_on_side - 1.0;
    const Vec2 x = 0.5 * xi * (xi - 1.0) * start + (1.0 - xi * xi) * loop.middles[side] +
                   0.5 * xi * (xi + 1.0) * end;
    places[i] = in_space(x);
  }
  return places;
}

/// Places that a tool will have reached, on each side of each loop.
using Reached = std::vector<std::vector<std::vector<Vec2>>>;

/// Whether a face on a zone, or next to it, touches already: the zone is the end of a contact that
/// grows.
bool touches_near(const PartBoundary& boundary,
                  std::span<const int> touching,
                  std::span<const mechanics::Face> faces,
                  const ContactZone& zone) {
  constexpr std::size_t beside = 2; // sides
  const std::size_t n = boundary.loops[zone.loop].corners.size();
  for (std::size_t f = 0; f < touching.size(); ++f) {
    if (touching[f] < 0)
      continue;
    const SideNumber at = boundary.sides.at({faces[f].nodes[0], faces[f].nodes[1]});
    const std::size_t from_first = (idx(at.side) + n + beside - zone.first) % n;
    if (idx(at.loop) == zone.loop && from_first < zone.n_sides + 2 * beside)
      return true;
  }
  return false;
}

} // namespace

std::optional<FirstTouch> poor_first_touch(const Run& run, double dt) {
  const bool just_meshed =
      run.state.increment == run.state.mesh.increment && !run.state.record.remeshings.empty();
  if (!run.scene.remesh || !run.model.contact || run.mesh().dimension() != 2 ||
      run.state.leaving.decay_until > run.state.time || just_meshed ||
      run.state.mesh.refused_increment == run.state.increment)
    return std::nullopt;
  const std::vector<double> ahead = predicted(run, dt);
  const std::span<const double> nodes = std::span(ahead).first(run.n_nodal());
  std::vector<int> touching(run.part().contact_faces.size(), -1);
  const PartBoundary untouched = part_boundary(run.part(), nodes, touching, {});
  Reached reached;
  for (const geometry::SideLoop& loop : untouched.loops)
    reached.emplace_back(loop.corners.size());
  for (std::size_t f = 0; f < touching.size(); ++f) {
    const mechanics::Face& face = run.part().contact_faces[f];
    const SideNumber at = untouched.sides.at({face.nodes[0], face.nodes[1]});
    const auto places = places_on(untouched.loops[idx(at.loop)], idx(at.side));
    for (std::size_t t = 0; t < run.tools().size(); ++t) {
      if (!run.model.contact->acts(t, run.state.time + dt))
        continue;
      const geometry::Pose pose = run.model.contact->pose(t, run.state.time + dt, ahead);
      std::array<Vec3, places_on_side> seen;
      std::transform(places.begin(), places.end(), seen.begin(),
                     [&](const Vec3& x) { return pose.to_tool(x); });
      std::array<geometry::Projection, places_on_side> feet;
      run.tools()[t].surface->project(seen, reach * run.state.mesh.first_side, feet);
      for (std::size_t i = 0; i < feet.size(); ++i)
        if (feet[i].found() && feet[i].gap < 0.0) {
          touching[f] = static_cast<int>(t);
          reached[idx(at.loop)][idx(at.side)].emplace_back(places[i].head<2>());
        }
    }
  }
  const std::vector<int> touched = touching_tools(run);
  std::optional<FirstTouch> touch;
  for (ContactZone zone : contact_zones(part_boundary(run.part(), nodes, touching, {}))) {
    zone.longest = zone.longest && run.model.contact->closed()[idx(zone.tool)].empty();
    if (touches_near(untouched, touched, run.part().contact_faces, zone) ||
        !can_be_refined(run, zone) || leaves(run, idx(zone.tool)))
      continue;
    const auto& sides = reached[zone.loop];
    std::vector<Vec2> places;
    for (std::size_t j = 0; j < zone.n_sides; ++j) {
      const std::vector<Vec2>& more = sides[(zone.first + j) % sides.size()];
      places.insert(places.end(), more.begin(), more.end());
    }
    const double share =
        static_cast<double>(places.size()) / static_cast<double>(zone.n_sides * places_on_side);
    const double size = usual_sizes(run).zones.in(zone, share * zone.length);
    if (!touch)
      touch = FirstTouch{
          fmt::format("{} comes to touch on {}", run.tools()[idx(zone.tool)].name, sides_of(zone)),
          {}};
    for (const Vec2& x : places)
      touch->sizes.push_back({x, size});
  }
  return touch;
}

} // namespace billet::process
