#include "geometry/repair/mesh_stitch.h"

#include "geometry/triangles/box_pairs.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

// Pairs looked at for each border edge before the search is given up: a heap of points.
constexpr std::size_t most_stitches_each = 100;

/// The border of a mesh.
struct Border {
  std::vector<EdgeUse> edges;
  std::vector<std::int32_t> points; ///< sorted
};

Border border_of(const TriangleMesh& mesh) {
  Border border;
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 1)
      return;
    border.edges.push_back(uses[0]);
    border.points.push_back(uses[0].low);
    border.points.push_back(uses[0].high);
  });
  std::sort(border.points.begin(), border.points.end());
  border.points.erase(std::unique(border.points.begin(), border.points.end()), border.points.end());
  return border;
}

const Vec3& point(const TriangleMesh& mesh, std::int32_t i) {
  return mesh.points[static_cast<std::size_t>(i)];
}

Box grown(const Vec3& a, const Vec3& b, double by) {
  Box box;
  for (const Vec3& p : {a, b}) {
    box.add(p.array() + by);
    box.add(p.array() - by);
  }
  return box;
}

std::vector<Box> point_boxes(const TriangleMesh& mesh, const Border& border, double by) {
  std::vector<Box> boxes;
  for (const std::int32_t i : border.points)
    boxes.push_back(grown(point(mesh, i), point(mesh, i), by));
  return boxes;
}

// A quarter of the shortest border edge at each border point: what may merge with it.
std::vector<double> elbow_room(const TriangleMesh& mesh, const Border& border) {
  std::vector<double> room(mesh.points.size(), std::numeric_limits<double>::infinity());
  for (const EdgeUse& edge : border.edges) {
    const double quarter = 0.25 * (point(mesh, edge.low) - point(mesh, edge.high)).norm();
    for (const std::int32_t i : {edge.low, edge.high})
      room[static_cast<std::size_t>(i)] = std::min(room[static_cast<std::size_t>(i)], quarter);
  }
  return room;
}

// Pairs of border points that may merge, either way round, sorted.
std::vector<std::pair<std::int32_t, std::int32_t>>
near_points(const TriangleMesh& mesh, const Border& border, double tolerance) {
  const std::vector<double> room = elbow_room(mesh, border);
  const std::vector<Box> boxes = point_boxes(mesh, border, 0.5 * tolerance);
  std::vector<std::pair<std::int32_t, std::int32_t>> found;
  std::size_t looked_at = 0;
  visit_box_pairs(boxes, [&](std::int32_t i, std::int32_t j) {
    const std::int32_t a = border.points[static_cast<std::size_t>(i)];
    const std::int32_t b = border.points[static_cast<std::size_t>(j)];
    const double limit =
        std::min({tolerance, room[static_cast<std::size_t>(a)], room[static_cast<std::size_t>(b)]});
    if ((point(mesh, a) - point(mesh, b)).norm() <= limit) {
      found.emplace_back(a, b);
      found.emplace_back(b, a);
    }
    return ++looked_at < most_stitches_each * border.points.size();
  });
  std::sort(found.begin(), found.end());
  return found;
}

// The point of smallest number takes all its neighbours that no other has taken. A point moves
// once.
void merge_points(TriangleMesh& mesh, double tolerance, Stitching& done) {
  std::vector<std::int32_t> target(mesh.points.size(), -1);
  for (const auto& [to, from] : near_points(mesh, border_of(mesh), tolerance)) {
    std::int32_t& centre = target[static_cast<std::size_t>(to)];
    std::int32_t& moved = target[static_cast<std::size_t>(from)];
    if ((centre >= 0 && centre != to) || moved >= 0)
      continue;
    centre = to;
    moved = to;
    ++done.merged_points;
    done.largest_move = std::max(done.largest_move, (point(mesh, to) - point(mesh, from)).norm());
  }
  for (std::array<std::int32_t, 3>& t : mesh.triangles)
    for (std::int32_t& v : t)
      if (target[static_cast<std::size_t>(v)] >= 0)
        v = target[static_cast<std::size_t>(v)];
}

// A border point on a border edge: how far along, the point, how far off.
struct OnEdge {
  double along;
  std::int32_t point;
  double off;
};

// By (triangle, side), so that the result does not depend on the order of the search.
using Junctions = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<OnEdge>>;

Junctions junctions_of(const TriangleMesh& mesh, const Border& border, double tolerance) {
  std::vector<Box> edges;
  for (const EdgeUse& edge : border.edges)
    edges.push_back(grown(point(mesh, edge.low), point(mesh, edge.high), tolerance));
  const std::vector<Box> points = point_boxes(mesh, border, 0.0);
  Junctions found;
  std::size_t looked_at = 0;
  visit_box_pairs(edges, points, [&](std::int32_t e, std::int32_t p) {
    const EdgeUse& edge = border.edges[static_cast<std::size_t>(e)];
    const std::array<std::int32_t, 3>& t = mesh.triangles[static_cast<std::size_t>(edge.triangle)];
    const std::int32_t v = border.points[static_cast<std::size_t>(p)];
    const auto side = static_cast<std::size_t>(edge.side);
    const Vec3& from = point(mesh, t[side]);
    const Vec3 way = point(mesh, t[(side + 1) % 3]) - from;
    const double length = way.norm(), along = (point(mesh, v) - from).dot(way) / length;
    const double off = (point(mesh, v) - from - along / length * way).norm();
    if (off <= tolerance && along > tolerance && along < length - tolerance &&
        std::find(t.begin(), t.end(), v) == t.end())
      found[{edge.triangle, edge.side}].push_back({along, v, off});
    return ++looked_at < most_stitches_each * border.points.size();
  });
  return found;
}

// One side of each triangle a pass; a fan from the corner across it takes the triangle's place.
bool insert_points(TriangleMesh& mesh, double tolerance, Stitching& done) {
  Junctions junctions = junctions_of(mesh, border_of(mesh), tolerance);
  std::int32_t last = -1;
  for (auto& [place, points] : junctions) {
    if (place.first == last)
      continue;
    last = place.first;
    std::sort(points.begin(), points.end(), [](const OnEdge& a, const OnEdge& b) {
      return std::tie(a.along, a.point) < std::tie(b.along, b.point);
    });
    const auto t = static_cast<std::size_t>(place.first);
    const auto side = static_cast<std::size_t>(place.second);
    const std::array<std::int32_t, 3> old = mesh.triangles[t];
    const std::int32_t across = old[(side + 2) % 3];
    std::int32_t from = old[side];
    mesh.triangles[t] = {from, points[0].point, across};
    for (std::size_t i = 0; i < points.size(); ++i) {
      done.largest_move = std::max(done.largest_move, points[i].off);
      if (i > 0)
        mesh.triangles.push_back({from, points[i].point, across});
      from = points[i].point;
      ++done.t_junctions;
    }
    mesh.triangles.push_back({from, old[(side + 1) % 3], across});
  }
  return !junctions.empty();
}

} // namespace

Stitching stitch(TriangleMesh& mesh, double tolerance) {
  constexpr int passes = 4; // a triangle has three sides, and one pass sees what the last has made
  Stitching done;
  merge_points(mesh, tolerance, done);
  for (int pass = 0; pass < passes && insert_points(mesh, tolerance, done); ++pass) {
  }
  return done;
}

} // namespace billet::geometry
