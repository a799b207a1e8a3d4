#include "geometry/repair/mesh_orientation.h"

#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// An open sheet that disagrees by more than this share of its area has no front.
constexpr double largest_minority = 1.0 / 3.0;

// Triangles across the three sides; -1: none, or more than one.
struct Neighbours {
  std::vector<std::array<std::int32_t, 3>> across;
  std::vector<std::array<char, 3>> turned; ///< faces the other way
};

Neighbours neighbours_of(const TriangleMesh& mesh) {
  Neighbours n;
  n.across.assign(mesh.triangles.size(), {-1, -1, -1});
  n.turned.assign(mesh.triangles.size(), {0, 0, 0});
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2)
      return;
    for (const auto& [use, other] : {std::pair{uses[0], uses[1]}, std::pair{uses[1], uses[0]}}) {
      const auto t = static_cast<std::size_t>(use.triangle);
      const auto side = static_cast<std::size_t>(use.side);
      n.across[t][side] = other.triangle;
      n.turned[t][side] = use.forward == other.forward ? 1 : 0;
    }
  });
  return n;
}

// Triangles that hang together, and whether each agrees with the first.
struct Patch {
  std::vector<std::int32_t> triangles;
  std::array<double, 2> area{0.0, 0.0}; ///< of those that agree, and of the others
  bool closed = true;
};

Patch patch_from(const TriangleMesh& mesh,
                 const Neighbours& neighbours,
                 std::int32_t first,
                 std::vector<char>& turned) {
  constexpr char unknown = 2;
  Patch patch{{first}};
  turned[static_cast<std::size_t>(first)] = 0;
  for (std::size_t next = 0; next < patch.triangles.size(); ++next) {
    const auto t = static_cast<std::size_t>(patch.triangles[next]);
    patch.area[turned[t] != 0 ? 1 : 0] += 0.5 * doubled_area(mesh, mesh.triangles[t]).norm();
    for (std::size_t side = 0; side < 3; ++side) {
      const std::int32_t across = neighbours.across[t][side];
      patch.closed = patch.closed && across >= 0;
      if (across < 0 || turned[static_cast<std::size_t>(across)] != unknown)
        continue;
      turned[static_cast<std::size_t>(across)] =
          static_cast<char>(turned[t] ^ neighbours.turned[t][side]);
      patch.triangles.push_back(across);
    }
  }
  return patch;
}

// Around an edge: where a triangle starts, seen along the edge, and on which side it has material.
struct Sector {
  double angle;
  const EdgeUse* use;
  std::int32_t across; ///< the triangle's third corner
};

std::vector<Sector> sectors_around(const TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  const Vec3& a = mesh.points[static_cast<std::size_t>(uses[0].low)];
  const Vec3 along = (mesh.points[static_cast<std::size_t>(uses[0].high)] - a).stableNormalized();
  const Vec3 e1 = along.unitOrthogonal(), e2 = along.cross(e1);
  std::vector<Sector> sectors;
  for (const EdgeUse& use : uses) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(use.triangle)];
    const std::int32_t across = t[static_cast<std::size_t>((use.side + 2) % 3)];
    const Vec3 w = mesh.points[static_cast<std::size_t>(across)] - a;
    sectors.push_back({std::atan2(w.dot(e2), w.dot(e1)), &use, across});
  }
  std::sort(sectors.begin(), sectors.end(),
            [](const Sector& s, const Sector& t) { return s.angle < t.angle; });
  return sectors;
}

// With growing angle, material begins at a triangle that runs against the edge and ends at one that
// runs along it. Where two coincide, one body ends before the next begins. False if the triangles
// do not alternate.
bool alternate(std::vector<Sector>& sectors) {
  constexpr double coincident = 1e-6; // [rad]
  const std::size_t n = sectors.size();
  const auto gap = [](const Sector& from, const Sector& to) {
    return std::remainder(to.angle - from.angle, 2.0 * std::numbers::pi);
  };
  for (std::size_t i = 0; i < n; ++i) {
    Sector &s = sectors[i], &next = sectors[(i + 1) % n];
    if (!s.use->forward && next.use->forward && std::abs(gap(s, next)) < coincident)
      std::swap(s, next);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (sectors[i].use->forward == sectors[(i + 1) % n].use->forward ||
        sectors[i].across == sectors[(i + 1) % n].across)
      return false;
  return true;
}

void join(DisjointSets& fans, const EdgeUse& a, const EdgeUse& b) {
  fans.join(corner_at_low(a), corner_at_low(b));
  fans.join(corner_at_high(a), corner_at_high(b));
}

} // namespace

std::int64_t orient(TriangleMesh& mesh) {
  const Neighbours neighbours = neighbours_of(mesh);
  constexpr char unknown = 2;
  std::vector<char> turned(mesh.triangles.size(), unknown);
  std::int64_t count = 0;
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (turned[first] != unknown)
      continue;
    const Patch patch = patch_from(mesh, neighbours, static_cast<std::int32_t>(first), turned);
    const char minority = patch.area[1] <= patch.area[0] ? 1 : 0;
    const double share = patch.area[minority != 0 ? 1 : 0];
    if (!patch.closed && share > largest_minority * (patch.area[0] + patch.area[1]))
      continue;
    for (const std::int32_t number : patch.triangles) {
      const auto t = static_cast<std::size_t>(number);
      if (turned[t] != minority)
        continue;
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++count;
    }
  }
  return count;
}

std::int64_t split_fans(TriangleMesh& mesh) {
  DisjointSets fans(3 * mesh.triangles.size());
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() <= 2) {
      join(fans, uses.front(), uses.back());
      return;
    }
    std::vector<Sector> sectors = sectors_around(mesh, uses);
    const bool pairs = alternate(sectors);
    for (std::size_t i = 0; i < sectors.size(); ++i)
      if (!pairs || !sectors[i].use->forward)
        join(fans, *sectors[i].use, *sectors[(i + 1) % sectors.size()].use);
  });
  std::vector<std::int32_t> point(3 * mesh.triangles.size(), -1);
  std::vector<char> taken(mesh.points.size(), 0);
  std::int64_t added = 0;
  for (std::size_t k = 0; k < point.size(); ++k) {
    std::int32_t& v = mesh.triangles[k / 3][k % 3];
    std::int32_t& own = point[static_cast<std::size_t>(fans.root(static_cast<std::int32_t>(k)))];
    if (own < 0 && taken[static_cast<std::size_t>(v)] == 0) {
      taken[static_cast<std::size_t>(v)] = 1;
      own = v;
    } else if (own < 0) {
      own = static_cast<std::int32_t>(mesh.points.size());
      const Vec3 copy = mesh.points[static_cast<std::size_t>(v)];
      mesh.points.push_back(copy);
      ++added;
    }
    v = own;
  }
  return added;
}

} // namespace billet::geometry
