#include "geometry/repair/mesh_parts.h"

#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

// Beyond this, nesting is not looked at: every pair of parts with nested boxes costs a sum over the
// triangles of one.
constexpr std::size_t most_nested_parts = 1000;
constexpr double most_angles = 2e8;

void number_parts(const TriangleMesh& mesh, MeshParts& parts) {
  DisjointSets sets(mesh.points.size());
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    std::int32_t& part = number[static_cast<std::size_t>(sets.root(t[0]))];
    if (part < 0) {
      part = static_cast<std::int32_t>(parts.list.size());
      parts.list.emplace_back().at = corner(mesh, t, 0);
    }
    parts.of_triangle.push_back(part);
    MeshPart& list = parts.list[static_cast<std::size_t>(part)];
    ++list.triangles;
    for (std::size_t i = 0; i < 3; ++i)
      list.bounds.add(corner(mesh, t, i));
  }
}

void measure(const TriangleMesh& mesh, MeshParts& parts) {
  const auto part_of = [&](std::size_t t) -> MeshPart& {
    return parts.list[static_cast<std::size_t>(parts.of_triangle[t])];
  };
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2 || uses[0].forward == uses[1].forward)
      part_of(static_cast<std::size_t>(uses[0].triangle)).closed = false;
  });
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    MeshPart& part = part_of(t);
    const Vec3 middle = 0.5 * (part.bounds.low + part.bounds.high);
    if (part.closed)
      part.volume +=
          doubled_area(mesh, mesh.triangles[t]).dot(corner(mesh, mesh.triangles[t], 0) - middle) /
          6.0;
  }
}

bool holds(const Box& outer, const Box& inner) {
  return (outer.low.array() <= inner.low.array()).all() &&
         (inner.high.array() <= outer.high.array()).all();
}

// Whether the shell of these triangles winds around x: sum of solid angles over 4 pi.
bool winds_around(const TriangleMesh& mesh,
                  const std::vector<std::int32_t>& triangles,
                  const Vec3& x) {
  double angle = 0.0;
  for (const std::int32_t number : triangles) {
    const std::array<std::int32_t, 3>& t = mesh.triangles[static_cast<std::size_t>(number)];
    const Vec3 a = corner(mesh, t, 0) - x, b = corner(mesh, t, 1) - x, c = corner(mesh, t, 2) - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;
}

void find_nesting(const TriangleMesh& mesh, MeshParts& parts) {
  const std::size_t n = parts.list.size();
  if (n < 2)
    return;
  double angles = 0.0;
  std::vector<std::pair<std::size_t, std::size_t>> pairs; // (outer, inner) by their boxes
  for (std::size_t i = 0; i < n && n <= most_nested_parts; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j && parts.list[i].closed && holds(parts.list[i].bounds, parts.list[j].bounds)) {
        pairs.emplace_back(i, j);
        angles += static_cast<double>(parts.list[i].triangles);
      }
  parts.nesting_known = n <= most_nested_parts && angles <= most_angles;
  if (!parts.nesting_known || pairs.empty())
    return;
  std::vector<std::vector<std::int32_t>> triangles(n);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    triangles[static_cast<std::size_t>(parts.of_triangle[t])].push_back(
        static_cast<std::int32_t>(t));
  for (const auto& [outer, inner] : pairs)
    if (winds_around(mesh, triangles[outer], parts.list[inner].at))
      parts.list[inner].in.push_back(static_cast<std::int32_t>(outer));
}

} // namespace

MeshParts parts_of(const TriangleMesh& mesh) {
  MeshParts parts;
  number_parts(mesh, parts);
  measure(mesh, parts);
  find_nesting(mesh, parts);
  return parts;
}

std::int64_t turn_outwards(TriangleMesh& mesh, MeshParts& parts, bool all) {
  if (!parts.nesting_known)
    return 0;
  const auto outer = [](const MeshPart& part) { return part.closed && part.in.empty(); };
  const bool another = std::any_of(parts.list.begin(), parts.list.end(), [&](const MeshPart& part) {
    return outer(part) && part.volume > 0.0;
  });
  if (!all && !another)
    return 0;
  std::vector<char> turn(parts.list.size(), 0);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < parts.list.size(); ++i)
    if (outer(parts.list[i]) && parts.list[i].volume < 0.0) {
      turn[i] = 1;
      ++count;
    }
  // Cavities were turned inside out with the body they belong to.
  for (std::size_t i = 0; i < parts.list.size(); ++i)
    if (parts.list[i].in.size() == 1 && parts.list[i].volume > 0.0 &&
        turn[static_cast<std::size_t>(parts.list[i].in[0])] != 0)
      turn[i] = 1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (turn[static_cast<std::size_t>(parts.of_triangle[t])] != 0)
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  for (std::size_t i = 0; i < parts.list.size(); ++i)
    parts.list[i].volume *= turn[i] != 0 ? -1.0 : 1.0;
  return count;
}

} // namespace billet::geometry
