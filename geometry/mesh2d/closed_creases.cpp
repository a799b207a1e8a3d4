#include "geometry/mesh2d/closed_creases.h"

#include "geometry/base/box.h"
#include "geometry/base/index.h"
#include "geometry/mesh3d/wall_widths.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/repair/self_intersection.h"
#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

/// What may be drawn flat, of the whole.
constexpr double most_drawn_area = 0.1;
constexpr double most_filled_volume = 0.01;

/// How far the rim lies beyond what cuts, of the shortest edge: at first, and by what it grows.
constexpr double first_reach = 0.5;
constexpr double growth = 1.5;
constexpr int most_tries = 8;

Vec3 middle(const TriangleMesh& mesh, std::size_t t) {
  const auto& triangle = mesh.triangles[t];
  return (corner(mesh, triangle, 0) + corner(mesh, triangle, 1) + corner(mesh, triangle, 2)) / 3.0;
}

double area(const TriangleMesh& mesh, std::size_t t) {
  return 0.5 * doubled_area(mesh, mesh.triangles[t]).norm();
}

/// Triangles that cut others, or face them across a narrow gap.
std::vector<std::int32_t> walls(const TriangleMesh& mesh, double near) {
  std::set<std::int32_t> found;
  for (const auto& pair : cutting_pairs(mesh))
    found.insert(pair.begin(), pair.end());
  if (found.empty() && near > 0.0 && complaints(health(mesh), "").empty())
    for (const WallWidth& gap : wall_widths(mesh, near))
      if (gap.outside)
        found.insert(gap.triangle);
  return {found.begin(), found.end()};
}

/// The neighbours of each point, and the lines that stay.
class Net {
public:
  explicit Net(const SolidBoundary& boundary) : boundary_(boundary) {
    const std::size_t n = boundary.mesh.points.size();
    beside_.resize(n);
    on_line_.resize(n);
    around_.resize(n);
    for (std::size_t t = 0; t < boundary.mesh.triangles.size(); ++t)
      for (const std::int32_t p : boundary.mesh.triangles[t])
        around_[idx(p)].push_back(static_cast<std::int32_t>(t));
    std::set<std::array<std::int32_t, 2>> lines; // the smaller point first
    for (const auto& [a, b] : boundary.lines)
      lines.insert({std::min(a, b), std::max(a, b)});
    for_each_edge(edge_uses(boundary.mesh), [&](std::span<const EdgeUse> uses) {
      const std::int32_t a = uses.front().low, b = uses.front().high;
      beside_[idx(a)].push_back(b);
      beside_[idx(b)].push_back(a);
      const std::int32_t part = boundary.part[idx(uses.front().triangle)];
      if (boundary.part[idx(uses.back().triangle)] != part || lines.contains({a, b})) {
        on_line_[idx(a)].push_back(b);
        on_line_[idx(b)].push_back(a);
      }
    });
  }

  /// Triangles at a point.
  [[nodiscard]] const std::vector<std::int32_t>& around(std::int32_t point) const {
    return around_[idx(point)];
  }

  /// The points whose mean a point moves to; empty: it stays.
  [[nodiscard]] std::span<const std::int32_t> moves_between(std::int32_t point) const {
    constexpr std::size_t within = 2; // points of a line that goes on
    const std::vector<std::int32_t>& line = on_line_[idx(point)];
    if (boundary_.keep[idx(point)] != 0 || (!line.empty() && line.size() != within))
      return {};
    return line.empty() ? beside_[idx(point)] : line;
  }

private:
  const SolidBoundary& boundary_;
  std::vector<std::vector<std::int32_t>> beside_, on_line_, around_;
};

/// Triangles that hang together with the walls and have a corner no farther from one of theirs than
/// `reach`, in order.
std::vector<std::int32_t> within_reach(const TriangleMesh& mesh,
                                       const Net& net,
                                       std::span<const std::int32_t> walls,
                                       double reach) {
  std::set<std::int32_t> region(walls.begin(), walls.end());
  std::map<std::int32_t, double> reached; // points, and how far they are by way of edges
  std::set<std::pair<double, std::int32_t>> next;
  for (const std::int32_t t : walls)
    for (const std::int32_t p : mesh.triangles[idx(t)])
      if (reached.emplace(p, 0.0).second)
        next.emplace(0.0, p);
  while (!next.empty()) {
    const auto [far, point] = *next.begin();
    next.erase(next.begin());
    if (far > reached.at(point))
      continue;
    for (const std::int32_t t : net.around(point)) {
      region.insert(t);
      for (const std::int32_t p : mesh.triangles[idx(t)]) {
        const double way = far + (mesh.points[idx(p)] - mesh.points[idx(point)]).norm();
        const auto known = reached.find(p);
        if (way > reach || (known != reached.end() && known->second <= way))
          continue;
        reached[p] = way;
        next.emplace(way, p);
      }
    }
  }
  return {region.begin(), region.end()};
}

/// Points all of whose triangles are in the region and that may move, in order.
std::vector<std::int32_t>
inner_points(const TriangleMesh& mesh, const Net& net, std::span<const std::int32_t> region) {
  std::set<std::int32_t> inner;
  for (const std::int32_t t : region)
    for (const std::int32_t p : mesh.triangles[idx(t)])
      if (!net.moves_between(p).empty() &&
          std::all_of(net.around(p).begin(), net.around(p).end(), [&](std::int32_t beside) {
            return std::binary_search(region.begin(), region.end(), beside);
          }))
        inner.insert(p);
  return {inner.begin(), inner.end()};
}

/// Puts each of these points into the mean of its neighbours: wherever they were, what they span
/// depends on the rim alone (Tutte 1963).
void span_skin(TriangleMesh& mesh, const Net& net, std::span<const std::int32_t> inner) {
  const auto n = static_cast<Eigen::Index>(inner.size());
  const auto unknown = [&](std::int32_t point) -> Eigen::Index {
    const auto at = std::lower_bound(inner.begin(), inner.end(), point);
    return at != inner.end() && *at == point ? at - inner.begin() : -1;
  };
  // In a plane of symmetry points stay to the bit.
  std::vector<std::array<bool, 3>> lies_level;
  for (const std::int32_t point : inner) {
    const auto between = net.moves_between(point);
    std::array<bool, 3>& level = lies_level.emplace_back();
    for (int k = 0; k < 3; ++k)
      level[static_cast<std::size_t>(k)] =
          std::all_of(between.begin(), between.end(), [&](std::int32_t p) {
            return mesh.points[idx(p)][k] == mesh.points[idx(point)][k];
          });
  }
  const Vec3 origin = mesh.points[idx(inner.front())]; // against rounding far from zero
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d rim = Eigen::MatrixX3d::Zero(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto between = net.moves_between(inner[static_cast<std::size_t>(i)]);
    entries.emplace_back(i, i, static_cast<double>(between.size()));
    for (const std::int32_t p : between)
      if (const Eigen::Index j = unknown(p); j >= 0)
        entries.emplace_back(i, j, -1.0);
      else
        rim.row(i) += mesh.points[idx(p)] - origin;
  }
  Eigen::SparseMatrix<double> means(n, n);
  means.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(means);
  if (factors.info() != Eigen::Success)
    return; // points that hang on no rim: the boundary stays as it is
  const Eigen::MatrixX3d skin = factors.solve(rim);
  for (Eigen::Index i = 0; i < n; ++i) {
    Vec3& x = mesh.points[idx(inner[static_cast<std::size_t>(i)])];
    const Vec3 to = origin + Vec3(skin.row(i).transpose());
    for (int k = 0; k < 3; ++k)
      if (!lies_level[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)])
        x[k] = to[k];
  }
}

/// The creases that a region consists of.
std::vector<ClosedCrease> creases_of(const TriangleMesh& before,
                                     const TriangleMesh& after,
                                     std::span<const std::int32_t> walls,
                                     std::span<const std::int32_t> region) {
  DisjointSets hang_together(before.points.size());
  for (const std::int32_t t : region)
    for (const std::int32_t p : before.triangles[idx(t)])
      hang_together.join(p, before.triangles[idx(t)].front());
  struct Crease {
    Vec3 sum = Vec3::Zero();
    double n = 0.0;
    double depth = 0.0;
  };
  std::map<std::int32_t, Crease> found;
  for (const std::int32_t t : walls) {
    Crease& crease = found[hang_together.root(before.triangles[idx(t)].front())];
    crease.sum += middle(before, idx(t));
    crease.n += 1.0;
  }
  for (const std::int32_t t : region)
    for (const std::int32_t p : before.triangles[idx(t)]) {
      double& depth = found[hang_together.root(p)].depth;
      depth = std::max(depth, (after.points[idx(p)] - before.points[idx(p)]).norm());
    }
  std::vector<ClosedCrease> creases;
  creases.reserve(found.size());
  for (const auto& [root, crease] : found)
    creases.push_back({crease.sum / crease.n, crease.depth});
  return creases;
}

/// Whether the boundary may go on so.
bool is_sound(const TriangleMesh& before, const TriangleMesh& after) {
  const MeshHealth was = health(before), is = health(after);
  return is.degenerate_triangles == 0 &&
         std::abs(is.volume - was.volume) <= most_filled_volume * was.volume &&
         cutting_pairs(after).empty();
}

void forget_creases(SolidBoundary& boundary, std::span<const std::int32_t> inner) {
  const auto is_inner = [&](std::int32_t point) {
    return std::binary_search(inner.begin(), inner.end(), point);
  };
  if (boundary.creases)
    std::erase_if(*boundary.creases,
                  [&](const auto& edge) { return is_inner(edge[0]) || is_inner(edge[1]); });
}

} // namespace

std::optional<ClosedCrease> cut_at(const TriangleMesh& mesh) {
  const std::vector<std::int32_t> at = walls(mesh, 0.0);
  if (at.empty())
    return std::nullopt;
  Box box;
  for (const std::int32_t t : at)
    box.add(middle(mesh, idx(t)));
  return ClosedCrease{0.5 * (box.low + box.high), 0.5 * (box.high - box.low).norm()};
}

std::vector<ClosedCrease> flatten_creases(SolidBoundary& boundary, double near, double rest) {
  const TriangleMesh& mesh = boundary.mesh;
  const std::vector<std::int32_t> at = walls(mesh, near);
  if (at.empty())
    return {};
  const Net net(boundary);
  double whole = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    whole += area(mesh, t);
  double reach = first_reach * rest;
  for (int i = 0; i < most_tries; ++i, reach *= growth) {
    const std::vector<std::int32_t> region = within_reach(mesh, net, at, reach);
    double drawn = 0.0;
    for (const std::int32_t t : region)
      drawn += area(mesh, idx(t));
    if (drawn > most_drawn_area * whole)
      break;
    const std::vector<std::int32_t> inner = inner_points(mesh, net, region);
    if (inner.empty())
      continue;
    TriangleMesh flat = mesh;
    span_skin(flat, net, inner);
    if (!is_sound(mesh, flat))
      continue;
    std::vector<ClosedCrease> creases = creases_of(mesh, flat, at, region);
    boundary.mesh = std::move(flat);
    forget_creases(boundary, inner);
    return creases;
  }
  return {};
}

} // namespace billet::geometry
