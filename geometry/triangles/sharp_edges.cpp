#include "geometry/triangles/sharp_edges.h"

#include "geometry/base/angle.h"
#include "geometry/base/box.h"
#include "geometry/base/index.h"
#include "geometry/triangles/disjoint_sets.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

/// Edges are continued by those to which the way is no longer than this, over the distance.
constexpr double detour = 1.9;         // below 2: opposite edges of a square are no continuation
constexpr std::size_t most_ways = 400; ///< points looked at from one place

/// A group of lines is a detail if the diagonal of its box is shorter than this, over the details:
/// the rim of a hole as wide as they are.
constexpr double group_share = 1.5;
constexpr double most_pieces_of_edge = 64.0; ///< of an edge

/// Pieces of edges that are kept, as a graph.
struct Graph {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 2>> pieces;
};

/// The pieces, as long as the details, to which no other edge is near.
Graph kept_pieces(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges, double details) {
  const SharpNetwork network(mesh, edges);
  Graph graph{mesh.points, {}};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec3 &a = mesh.points[idx(edges[i].a)], &b = mesh.points[idx(edges[i].b)];
    const int n = static_cast<int>(
        std::clamp(std::floor(edges[i].length / details), 1.0, most_pieces_of_edge));
    std::int32_t from = edges[i].a;
    for (int k = 1; k <= n; ++k) {
      std::int32_t to = edges[i].b;
      if (k < n) {
        to = static_cast<std::int32_t>(graph.points.size());
        graph.points.emplace_back(a + static_cast<double>(k) / n * (b - a));
      }
      const Vec3 middle = a + (k - 0.5) / n * (b - a);
      if (network.distance(static_cast<std::int32_t>(i), middle, details) >= details)
        graph.pieces.push_back({from, to});
      from = to;
    }
  }
  return graph;
}

void drop_small_groups(Graph& graph, double size) {
  DisjointSets groups(graph.points.size());
  for (const auto& [a, b] : graph.pieces)
    groups.join(a, b);
  std::map<std::int32_t, Box> boxes;
  for (const auto& [a, b] : graph.pieces)
    for (const std::int32_t end : {a, b})
      boxes[groups.root(end)].add(graph.points[idx(end)]);
  std::erase_if(graph.pieces, [&](const std::array<std::int32_t, 2>& piece) {
    return boxes.at(groups.root(piece[0])).size() < size;
  });
}

/// Walks the pieces from end to end; ends are where other than two of them meet.
std::vector<std::vector<Vec3>> chains(const Graph& graph) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < graph.pieces.size(); ++i)
    for (const std::int32_t end : graph.pieces[i])
      at[end].push_back(i);
  std::vector<char> done(graph.pieces.size(), 0);
  std::vector<std::vector<Vec3>> result;
  const auto walk = [&](std::int32_t first, std::size_t piece) {
    std::vector<Vec3>& chain = result.emplace_back();
    chain.push_back(graph.points[idx(first)]);
    for (std::int32_t here = first; done[piece] == 0;) {
      done[piece] = 1;
      const auto& [a, b] = graph.pieces[piece];
      here = a == here ? b : a;
      chain.push_back(graph.points[idx(here)]);
      const std::vector<std::size_t>& both = at.at(here);
      if (both.size() != 2)
        break;
      piece = both[0] == piece ? both[1] : both[0];
    }
  };
  for (const auto& [point, pieces] : at)
    for (const std::size_t piece : pieces)
      if (pieces.size() != 2 && done[piece] == 0)
        walk(point, piece);
  for (std::size_t piece = 0; piece < graph.pieces.size(); ++piece) // what is left is closed
    if (done[piece] == 0)
      walk(graph.pieces[piece][0], piece);
  return result;
}

} // namespace

std::vector<SharpEdge> sharp_edges(const TriangleMesh& mesh, double feature_angle) {
  std::vector<SharpEdge> edges;
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2)
      return;
    const Vec3 first = doubled_area(mesh, mesh.triangles[idx(uses[0].triangle)]),
               second = doubled_area(mesh, mesh.triangles[idx(uses[1].triangle)]);
    if (std::atan2(first.cross(second).norm(), first.dot(second)) > feature_angle * degree)
      edges.push_back({uses[0].low, uses[0].high,
                       (mesh.points[idx(uses[0].high)] - mesh.points[idx(uses[0].low)]).norm()});
  });
  return edges;
}

SharpNetwork::SharpNetwork(const TriangleMesh& mesh, const std::vector<SharpEdge>& edges)
    : mesh_(mesh), edges_(edges) {
  std::vector<Box> boxes(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const std::int32_t end : {edges[i].a, edges[i].b}) {
      boxes[i].add(mesh.points[idx(end)]);
      at_point_[end].push_back(static_cast<std::int32_t>(i));
    }
  tree_ = BoxTree(boxes);
}

double SharpNetwork::distance(std::int32_t edge, const Vec3& x, double most) const {
  const Ways from_here = ways(edge, x, detour * most);
  double nearest = most;
  tree_.walk(x, most * most, [&](std::int32_t other) {
    const Vec3 &a = point(other, 0), &b = point(other, 1);
    const double at = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double apart = (a + at * (b - a) - x).norm();
    if (other != edge && apart < nearest && way(from_here, other, at) > detour * apart)
      nearest = apart;
    return nearest * nearest;
  });
  return nearest;
}

const Vec3& SharpNetwork::point(std::int32_t edge, int end) const {
  return mesh_.points[idx(end == 0 ? edges_[idx(edge)].a : edges_[idx(edge)].b)];
}

/// Along the network from x on an edge to points no farther than `most`.
SharpNetwork::Ways SharpNetwork::ways(std::int32_t edge, const Vec3& x, double most) const {
  Ways done;
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  for (const std::int32_t end : {edges_[idx(edge)].a, edges_[idx(edge)].b})
    open.emplace((mesh_.points[idx(end)] - x).norm(), end);
  while (!open.empty() && done.size() < most_ways) {
    const auto [way, here] = open.top();
    open.pop();
    if (way > most || !done.try_emplace(here, way).second)
      continue;
    for (const std::int32_t next : at_point_.at(here)) {
      const SharpEdge& s = edges_[idx(next)];
      open.emplace(way + s.length, s.a == here ? s.b : s.a);
    }
  }
  return done;
}

/// To a place on an edge, from its end `a` at 0 to `b` at 1.
double SharpNetwork::way(const Ways& ways, std::int32_t edge, double at) const {
  double shortest = std::numeric_limits<double>::infinity();
  const SharpEdge& s = edges_[idx(edge)];
  if (const auto a = ways.find(s.a); a != ways.end())
    shortest = a->second + at * s.length;
  if (const auto b = ways.find(s.b); b != ways.end())
    shortest = std::min(shortest, b->second + (1.0 - at) * s.length);
  return shortest;
}

std::vector<std::vector<Vec3>>
lines_without_details(const TriangleMesh& mesh, double feature_angle, double details) {
  const std::vector<SharpEdge> edges = sharp_edges(mesh, feature_angle);
  Graph graph = kept_pieces(mesh, edges, details);
  drop_small_groups(graph, group_share * details);
  return chains(graph);
}

} // namespace billet::geometry
