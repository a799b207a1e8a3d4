#include "process/remeshing/new_part.h"

#include "geometry/base/error.h"
#include "process/remeshing/attachments.h"
#include "process/remeshing/contact_zones.h"
#include "process/remeshing/dead_forces.h"
#include "process/remeshing/inner_nodes.h"
#include "process/remeshing/laps.h"
#include "process/remeshing/onto_tools.h"
#include "process/remeshing/part_boundary.h"
#include "process/remeshing/parted_walls.h"
#include "process/remeshing/remeshing.h"
#include "process/remeshing/sizes.h"
#include "process/remeshing/solid_part.h"
#include "process/reports/lap.h"
#include "process/scene/scene.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Faces that touch a tool are off it by up to this share of their length.
constexpr double off = 0.05;

/// Length of the old edge that holds a place [mm].
double chord_at(const PartBoundary& boundary, const geometry::BoundaryPlace& place) {
  const std::vector<Vec2>& corners = boundary.loops[idx(place.loop)].corners;
  return (corners[(idx(place.side) + 1) % corners.size()] - corners[idx(place.side)]).norm();
}

/// What sizes are multiplied with for another mesh of the same part.
struct OtherSizes {
  double all;
  double shortest; ///< that the boundary's own curvature may ask for
};

/// With shorter edges than asked for where the boundary turns sharply, if it cannot be meshed
/// otherwise; `sizes` become those it was meshed with.
RemeshedPart remesh_finely_enough(const Part& part,
                                  const PartBoundary& boundary,
                                  geometry::RemeshSizes& sizes,
                                  const geometry::Snap& snap) {
  const double least = 0.25 * sizes.min;
  while (true) {
    try {
      return remesh_part(part, boundary, sizes, snap);
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry || sizes.min <= least)
        throw;
      sizes.min *= 0.5;
    }
  }
}

/// What `make` gives. A fold is welded only where there is no mesh otherwise: first where its walls
/// cross, then where it is narrower than edges of a new mesh are long.
///
/// @param weld      (near, shortest) -> folds that were welded; shortest edge of the new mesh
/// @param deepest   that may be welded [mm]
template <class Make, class Weld>
NewPart welded_where_needed(const Make& make, const Weld& weld, double shortest, double deepest) {
  constexpr std::array<double, 4> nears{0.0, 0.1, 0.3, 1.0}; // of the shortest
  std::vector<Lap> laps;
  std::size_t tried = 0;
  while (true)
    try {
      NewPart part = make();
      part.laps = std::move(laps);
      return part;
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry)
        throw;
      const std::size_t before = laps.size();
      while (laps.size() == before && tried < nears.size())
        for (const auto& fold : weld(nears[tried++] * shortest, shortest))
          laps.push_back(lap(fold));
      if (laps.size() == before || std::any_of(laps.begin(), laps.end(), [&](const Lap& each) {
            return each.depth > deepest;
          }))
        throw;
    }
}

NewPart
new_plane_part_within(const Run& run, const PartBoundary& boundary, const AskedSizes& asked) {
  const auto stops = std::make_shared<const ContactStops>(
      boundary, run.part().contact_faces,
      run.model.surface ? run.model.surface->line_coordinates() : std::vector<double>());
  const bool revolved = run.part().analysis == mechanics::Analysis::axisymmetric;
  geometry::Snap snap;
  if (run.model.contact)
    snap = [&run, &boundary, stops, revolved](
               std::int32_t part, const geometry::BoundaryPlace& place, const Vec2& x) -> Vec2 {
      const Attachment& attached = boundary.attachments[idx(part)];
      if (!attached.contact)
        return x;
      unsigned fixed = fixed_components(run.part(), boundary, part, place);
      if (revolved && x.x() == 0.0)
        fixed |= 1U;
      constexpr unsigned both = 3;
      if (fixed == both)
        return x;
      return projected_onto_tools(run, stops->around(place), in_space(x), attached.tool,
                                  {.most_gap = off * chord_at(boundary, place), .fixed = fixed})
          .head<2>();
    };
  geometry::RemeshSizes sizes = remesh_sizes(run);
  sizes.or_parabolas = !run.scene.remesh->weld; // a fold that closes is welded then
  sizes.at = contact_sizes(boundary, usual_sizes(run).zones);
  sizes.at.insert(sizes.at.end(), asked.at.begin(), asked.at.end());
  const std::vector<geometry::SizeAt> flow = sizes_for_flow(run);
  sizes.at.insert(sizes.at.end(), flow.begin(), flow.end());
  sizes.wanted = [wanted = sizes.wanted, &asked](const Vec2& x) { return asked.share * wanted(x); };
  RemeshedPart part = remesh_finely_enough(run.part(), boundary, sizes, snap);
  const auto with_sizes_times = [&](const OtherSizes& other) -> std::optional<RemeshedPart> {
    geometry::RemeshSizes scaled = sizes;
    scaled.min *= other.shortest;
    scaled.wanted = [&sizes, &other](const Vec2& x) { return other.all * sizes.wanted(x); };
    try {
      return remesh_part(run.part(), boundary, scaled, snap);
    } catch (const Error&) {
      return std::nullopt; // the first one is there
    }
  };
  // An edge that ends awkwardly next to a corner of a tool can spoil one element: others do not.
  constexpr double good = 0.3;
  constexpr std::array<OtherSizes, 5> other_sizes{
      {{0.93, 1.0}, {1.07, 1.0}, {0.87, 1.0}, {1.0, 0.5}, {0.93, 0.5}}};
  const auto quality = [](const RemeshedPart& of) {
    return worst_quality(of.mesh, mechanics::node_positions(of.mesh));
  };
  for (std::size_t i = 0; i < other_sizes.size() && quality(part) < good; ++i) {
    std::optional<RemeshedPart> other = with_sizes_times(other_sizes[i]);
    if (other && quality(*other) > quality(part))
      part = std::move(*other);
  }
  return {part,
          [stops, places = part.places](const contact::ContactSurface& surface,
                                        std::span<const double> /*x*/) {
            return point_sources(*stops, places, surface.line_coordinates());
          },
          {}};
}

constexpr double deepest_root = 4.0; ///< of a crease, in shortest edges of a new mesh

/// With walls that touch each other kept apart, if there is such a mesh. At the root of a crease,
/// where no mesh is fine enough, what crosses is welded.
std::optional<NewPart> new_plane_part_with_walls(const Run& run, const AskedSizes& asked) {
  if (!touches_itself(run))
    return std::nullopt;
  const double shortest = usual_sizes(run).min;
  const double deepest = deepest_root * shortest;
  // Roots whose walls do not cross, but turn more often than edges of a new mesh can follow. Where
  // folds may be welded the whole of it is.
  const std::vector<double> nears =
      run.scene.remesh->weld ? std::vector{0.0} : std::vector{0.0, 0.3, 1.0};
  for (const double near : nears)
    for (const double share : {0.03, 0.1, 0.3}) {
      PartBoundary boundary =
          part_boundary(run.part(), positions_with_parted_walls(run, share * shortest),
                        touching_tools(run), run.scene.remesh->keep);
      std::vector<Lap> roots;
      const auto note = [&](const geometry::ClosedFold& fold) {
        roots.push_back(lap(fold));
        roots.back().root = true;
      };
      // Nearer to each other than the walls that have been parted.
      for (const geometry::ClosedFold& fold :
           weld_folds(boundary, 0.5 * share * shortest, shortest))
        note(fold);
      if (std::any_of(roots.begin(), roots.end(),
                      [&](const Lap& root) { return root.depth > deepest; }))
        continue;
      if (near > 0.0)
        for (const geometry::ClosedFold& fold :
             weld_folds(boundary, near * shortest, shortest, deepest))
          note(fold);
      try {
        NewPart part = new_plane_part_within(run, boundary, asked);
        part.laps = std::move(roots);
        return part;
      } catch (const Error& error) {
        if (error.fault() != Fault::geometry)
          throw;
      }
    }
  return std::nullopt;
}

/// What is no more than the root of a crease, unless the case lets folds be welded.
double deepest_weld(const Run& run) {
  return run.scene.remesh->weld ? HUGE_VAL : deepest_root * usual_sizes(run).min;
}

NewPart new_plane_part(const Run& run, const AskedSizes& asked) {
  if (std::optional<NewPart> part = new_plane_part_with_walls(run, asked))
    return std::move(*part);
  PartBoundary boundary =
      part_boundary(run.part(), run.positions(), touching_tools(run), run.scene.remesh->keep);
  return welded_where_needed(
      [&] { return new_plane_part_within(run, boundary, asked); },
      [&](double near, double shortest) { return weld_folds(boundary, near, shortest); },
      usual_sizes(run).min, deepest_weld(run));
}

NewPart new_solid_part_within(const Run& run, const SolidPart& old, double share) {
  const auto neighbours = std::make_shared<const ContactNeighbours>(
      old, run.model.surface ? run.model.surface->face_coordinates() : std::vector<Vec2>());
  const auto supported = [&](std::span<const std::int32_t> parts, Vec3 x, const Vec3& on) {
    for (const std::int32_t part : parts)
      for (std::size_t s = 0; s < run.part().supports.size(); ++s)
        if (old.attachments[idx(part)].supports[s] != 0)
          x[run.part().supports[s].component] = on[run.part().supports[s].component];
    return x;
  };
  const auto snap = [&](std::span<const std::int32_t> parts, const geometry::SurfacePlace& place,
                        const Vec3& x) -> Vec3 {
    const auto& [a, b, c] = old.boundary.mesh.triangles[idx(place.triangle)];
    const std::vector<Vec3>& points = old.boundary.mesh.points;
    const Vec3& first = points[idx(a)];
    const Vec3 on = first + place.v * (points[idx(b)] - first) + place.w * (points[idx(c)] - first);
    const bool may_touch =
        run.model.contact && std::any_of(parts.begin(), parts.end(), [&](auto part) {
          return old.attachments[idx(part)].contact;
        });
    Vec3 result = supported(parts, x, on);
    // On a support and a tool at once: a few turns lead to where they meet.
    constexpr int turns = 4;
    for (int i = 0; may_touch && i < turns; ++i)
      result = supported(parts,
                         projected_onto_tools(run, neighbours->around(on), result, {},
                                              {.most_gap = run.state.mesh.first_side}),
                         on);
    return result;
  };
  geometry::SolidSizes sizes = solid_sizes(run);
  sizes.wanted = [wanted = sizes.wanted, share](const Vec3& x) { return share * wanted(x); };
  RemeshedPart part = remesh_part(run.part(), old, sizes, snap);
  return {std::move(part),
          [neighbours](const contact::ContactSurface& surface, std::span<const double> x) {
            std::vector<Vec3> points(surface.n_points());
            surface.positions(x, points);
            std::vector<contact::PointSource> sources;
            sources.reserve(points.size());
            for (const Vec3& point : points)
              sources.push_back(neighbours->around(point));
            return sources;
          }};
}

NewPart new_solid_part(const Run& run, double share) {
  SolidPart old =
      solid_part(run.part(), run.positions(), touching_tools(run), run.scene.remesh->keep);
  return welded_where_needed([&] { return new_solid_part_within(run, old, share); },
                             [&](double near, double shortest) {
                               return geometry::flatten_creases(old.boundary, near, shortest);
                             },
                             usual_sizes(run).min, HUGE_VAL);
}

} // namespace

NewPart new_part(const Run& run, const AskedSizes& asked) {
  NewPart anew =
      run.mesh().dimension() == 2 ? new_plane_part(run, asked) : new_solid_part(run, asked.share);
  add_inner_nodes(run.part(), run.positions(), anew.part);
  carry_dead_forces(run.part(), run.positions(), anew.part);
  return anew;
}

} // namespace billet::process
