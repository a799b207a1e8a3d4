#include "geometry/repair/mesh_repair.h"

#include "geometry/repair/mesh_orientation.h"
#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace billet::geometry {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// The other of two triangles with the same corners, -1: none. Repeated ones have been dropped, so
// these two lie back to back.
std::vector<std::int32_t> opposites(const TriangleMesh& mesh) {
  std::vector<std::pair<Triangle, std::int32_t>> keys;
  keys.reserve(mesh.triangles.size());
  for (Triangle t : mesh.triangles) {
    std::sort(t.begin(), t.end());
    keys.emplace_back(t, static_cast<std::int32_t>(keys.size()));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> partner(mesh.triangles.size(), -1);
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (keys[k].first == keys[k - 1].first) {
      partner[static_cast<std::size_t>(keys[k].second)] = keys[k - 1].second;
      partner[static_cast<std::size_t>(keys[k - 1].second)] = keys[k].second;
    }
  return partner;
}

// What the edges of a region of doubled faces say about it.
struct Rim {
  bool doubled_face = false; ///< one single face goes on: the region is part of that sheet
  bool inner_wall = false;   ///< two single faces go on: the region parts two bodies that are one
  bool free = false;         ///< nothing goes on
  bool unclear = false;
};

// Doubled faces that hang together, by their smallest triangle.
struct DoubledRegions {
  std::vector<std::int32_t> partner;
  std::vector<std::int32_t> region; ///< shape (n_triangles)
  std::vector<Rim> rims;            ///< shape (n_triangles), at the region's smallest triangle
};

DoubledRegions doubled_regions(const TriangleMesh& mesh, std::vector<std::int32_t> partner) {
  const std::size_t n = mesh.triangles.size();
  DoubledRegions found{std::move(partner), std::vector<std::int32_t>(n), std::vector<Rim>(n)};
  const auto doubled = [&](const EdgeUse& use) {
    return found.partner[static_cast<std::size_t>(use.triangle)] >= 0;
  };
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  DisjointSets regions(n);
  for (std::size_t t = 0; t < n; ++t)
    if (found.partner[t] >= 0)
      regions.join(static_cast<std::int32_t>(t), found.partner[t]);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 4 && std::all_of(edge.begin(), edge.end(), doubled))
      for (const EdgeUse& use : edge)
        regions.join(edge[0].triangle, use.triangle);
  });
  for (std::size_t t = 0; t < n; ++t)
    found.region[t] = regions.root(static_cast<std::int32_t>(t));
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const auto n_doubled = std::count_if(edge.begin(), edge.end(), doubled);
    const auto n_single = static_cast<std::ptrdiff_t>(edge.size()) - n_doubled;
    if (n_doubled == 0 || (n_doubled == 4 && n_single == 0))
      return;
    const EdgeUse& use = *std::find_if(edge.begin(), edge.end(), doubled);
    const auto region =
        static_cast<std::size_t>(found.region[static_cast<std::size_t>(use.triangle)]);
    Rim& rim = found.rims[region];
    rim.doubled_face = rim.doubled_face || (n_doubled == 2 && n_single == 1);
    rim.inner_wall = rim.inner_wall || (n_doubled == 2 && n_single == 2);
    rim.free = rim.free || (n_doubled == 2 && n_single == 0);
    rim.unclear = rim.unclear || n_doubled > 2 || n_single > 2;
  });
  return found;
}

// Of faces that lie back to back, one goes if the sheet around is single, and both go if they part
// two bodies glued together. A sheet that is double everywhere is left.
std::int64_t drop_opposites(TriangleMesh& mesh) {
  std::vector<std::int32_t> partner = opposites(mesh);
  if (std::all_of(partner.begin(), partner.end(), [](std::int32_t p) { return p < 0; }))
    return 0;
  const DoubledRegions found = doubled_regions(mesh, std::move(partner));
  std::vector<char> dropped(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (found.partner[t] < 0)
      continue;
    const Rim& rim = found.rims[static_cast<std::size_t>(found.region[t])];
    const bool wall = rim.inner_wall && !rim.free && !rim.doubled_face && !rim.unclear;
    const bool face = rim.doubled_face && !rim.inner_wall && !rim.unclear;
    dropped[t] = wall || (face && found.partner[t] < static_cast<std::int32_t>(t)) ? 1 : 0;
  }
  std::size_t next = 0;
  return static_cast<std::int64_t>(
      std::erase_if(mesh.triangles, [&](const Triangle&) { return dropped[next++] != 0; }));
}

void drop_unused_points(TriangleMesh& mesh) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::vector<Vec3> kept;
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) {
      std::int32_t& to = number[static_cast<std::size_t>(v)];
      if (to < 0) {
        to = static_cast<std::int32_t>(kept.size());
        kept.push_back(mesh.points[static_cast<std::size_t>(v)]);
      }
      v = to;
    }
  mesh.points = std::move(kept);
}

} // namespace

Repaired repair(TriangleMesh& mesh, double tolerance, double precision) {
  Repaired result;
  Repairs& done = result.done;
  done.tolerance = tolerance;
  done.clean_up = clean_up(mesh, precision);
  done.stitching = stitch(mesh, tolerance);
  drop_useless(mesh, done.clean_up);
  done.opposite_triangles = drop_opposites(mesh);
  done.turned_triangles = orient(mesh);
  // Diagonals are swapped between triangles that face the same way only: some wait for this.
  remove_slivers(mesh, precision, done.clean_up);
  done.parted_points = split_fans(mesh);
  drop_unused_points(mesh);
  result.parts = parts_of(mesh);
  done.turned_shells = turn_outwards(mesh, result.parts, done.turned_triangles > 0);
  return result;
}

std::vector<std::string> Repairs::notes() const {
  std::vector<std::string> notes;
  const auto note = [&](std::int64_t count, std::string_view what) {
    if (count > 0)
      notes.push_back(fmt::format("{} {}", count, what));
  };
  note(clean_up.degenerate_triangles, "degenerate triangles dropped");
  note(clean_up.duplicate_triangles, "duplicate triangles dropped");
  note(clean_up.slivers, "flat triangles merged with their neighbours");
  note(clean_up.collapsed_edges, "edges shorter than the precision drawn to a point");
  note(stitching.merged_points, "border points merged across cracks");
  note(stitching.t_junctions, "T-junctions closed");
  if (stitching.largest_move > 0.0)
    notes.push_back(fmt::format("the largest move was {:.3g}", stitching.largest_move));
  note(opposite_triangles, "triangles back to back with another one dropped");
  note(turned_triangles, "triangles turned to face as their neighbours do");
  note(parted_points, "points added where parts touch in a point or an edge");
  note(turned_shells, "closed parts turned to face outwards");
  return notes;
}

} // namespace billet::geometry
