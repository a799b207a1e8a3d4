#include "geometry/repair/mesh_health.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

using Triangle = std::array<std::int32_t, 3>;

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

std::int64_t repeats(std::vector<Triangle> triangles) {
  std::sort(triangles.begin(), triangles.end());
  const auto last = std::unique(triangles.begin(), triangles.end());
  return triangles.end() - last;
}

std::int64_t components(const TriangleMesh& mesh) {
  DisjointSets parts(mesh.points.size());
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) {
      used[static_cast<std::size_t>(v)] = 1;
      parts.join(t[0], v);
    }
  std::int64_t count = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto number = static_cast<std::int32_t>(i);
    count += used[i] != 0 && parts.root(number) == number ? 1 : 0;
  }
  return count;
}

void measure_triangles(const TriangleMesh& mesh, MeshHealth& health) {
  const double flat = coordinate_rounding(mesh);
  const Vec3 middle = 0.5 * (health.bounds.low + health.bounds.high); // against cancellation
  std::vector<Triangle> corners;
  corners.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 area = doubled_area(mesh, t);
    health.area += 0.5 * area.norm();
    health.volume += area.dot(corner(mesh, t, 0) - middle) / 6.0;
    corners.push_back(sorted(t));
    const TriangleShape shape = shape_of(mesh, t);
    const double aspect =
        shape.height > 0.0 ? shape.longest / shape.height : std::numeric_limits<double>::infinity();
    health.needles += aspect > needle_aspect ? 1 : 0;
    if (aspect > health.worst_aspect) {
      health.worst_aspect = aspect;
      health.worst_aspect_at = corner(mesh, t, 0);
    }
    if (shape.height > flat)
      continue;
    ++health.degenerate_triangles;
    if (!health.degenerate_at)
      health.degenerate_at = corner(mesh, t, 0);
  }
  health.duplicate_triangles = repeats(std::move(corners));
}

void note(std::int64_t& count, std::optional<Vec3>& first, const Vec3& at) {
  ++count;
  if (!first)
    first = at;
}

void count_edges(const TriangleMesh& mesh,
                 const std::vector<EdgeUse>& uses,
                 double feature_angle,
                 MeshHealth& health) {
  const double cosine = std::cos(feature_angle * degree);
  const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
  const auto normal = [&](const EdgeUse& use) {
    return doubled_area(mesh, mesh.triangles[static_cast<std::size_t>(use.triangle)]);
  };
  DisjointSets loops(mesh.points.size());
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const Vec3 at = 0.5 * (point(edge[0].low) + point(edge[0].high));
    if (edge.size() == 1) {
      note(health.border_edges, health.border_at, at);
      health.border_loops += loops.root(edge[0].low) == loops.root(edge[0].high) ? 1 : 0;
      loops.join(edge[0].low, edge[0].high);
    } else if (edge.size() > 2)
      note(health.non_manifold_edges, health.non_manifold_at, at);
    else if (edge[0].forward == edge[1].forward)
      note(health.inconsistent_edges, health.inconsistent_at, at);
    else {
      const Vec3 n = normal(edge[0]), m = normal(edge[1]);
      health.feature_edges += n.dot(m) < cosine * n.norm() * m.norm() ? 1 : 0;
    }
  });
}

// Corners at a vertex belong to one fan if edges join their triangles.
void count_touching_fans(const TriangleMesh& mesh,
                         const std::vector<EdgeUse>& uses,
                         MeshHealth& health) {
  DisjointSets fans(3 * mesh.triangles.size());
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge.subspan(1)) {
      fans.join(corner_at_low(edge[0]), corner_at_low(use));
      fans.join(corner_at_high(edge[0]), corner_at_high(use));
    }
  });
  std::vector<std::int32_t> first(mesh.points.size(), -1);
  std::vector<char> counted(mesh.points.size(), 0);
  for (std::size_t k = 0; k < 3 * mesh.triangles.size(); ++k) {
    const auto v = static_cast<std::size_t>(mesh.triangles[k / 3][k % 3]);
    const std::int32_t fan = fans.root(static_cast<std::int32_t>(k));
    if (first[v] < 0)
      first[v] = fan;
    if (first[v] == fan || counted[v] != 0)
      continue;
    counted[v] = 1;
    note(health.non_manifold_vertices, health.non_manifold_vertex_at, mesh.points[v]);
  }
}

} // namespace

std::string coordinates(const Vec3& x) {
  return fmt::format("({:g}, {:g}, {:g})", x.x(), x.y(), x.z());
}

MeshHealth health(const TriangleMesh& mesh, double feature_angle) {
  MeshHealth health;
  health.points = static_cast<std::int64_t>(mesh.points.size());
  health.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      health.bounds.add(corner(mesh, t, i));
  measure_triangles(mesh, health);
  health.components = components(mesh);
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  count_edges(mesh, uses, feature_angle, health);
  count_touching_fans(mesh, uses, health);
  if (!health.closed())
    health.volume = 0.0;
  return health;
}

std::vector<Complaint> complaints(const MeshHealth& health, const std::string& place) {
  std::vector<Complaint> found;
  if (health.triangles == 0)
    found.push_back({place, "the surface has no triangles", ""});
  if (health.degenerate_at)
    found.push_back({place,
                     fmt::format("{} triangles have no area, the first at {}",
                                 health.degenerate_triangles, coordinates(*health.degenerate_at)),
                     "repair the surface"});
  if (health.non_manifold_at)
    found.push_back({place,
                     fmt::format("{} edges belong to more than two triangles, the first at {}",
                                 health.non_manifold_edges, coordinates(*health.non_manifold_at)),
                     "remove inner walls and doubled faces"});
  if (health.inconsistent_at)
    found.push_back(
        {place,
         fmt::format("across {} edges the triangles face opposite ways, the first at {}",
                     health.inconsistent_edges, coordinates(*health.inconsistent_at)),
         "orient all triangles the same way; a one-sided surface (Moebius strip) has no outside"});
  if (health.duplicate_triangles > 0)
    found.push_back({place,
                     fmt::format("{} triangles lie on another one, facing the other way",
                                 health.duplicate_triangles),
                     "give the tool a thickness, or remove one of the two sheets"});
  return found;
}

} // namespace billet::geometry
