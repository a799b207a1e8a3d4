#include "geometry/collision/facet_body.h"

#include "geometry/base/box.h"
#include "geometry/base/index.h"
#include "geometry/base/limits.h"
#include "geometry/collision/facet_tree.h"
#include "geometry/triangles/segment_pair.h"
#include "geometry/triangles/triangle_mesh.h"
#include "geometry/triangles/triangle_pair.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

// Triangles of an area below 3e-8 have no normal for FCL's distances, whatever the unit.
constexpr double unit_share = 1e-6; // of the size of the scene

double unit(const FacetBody& body) { return unit_share * body.size(); }

FacetTree::Place place_of(const PlacedBody& placed) {
  FacetTree::Place place{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      place[idx(3 * i + j)] = placed.pose.rotation(i, j);
    place[idx(9 + i)] = placed.pose.translation[i] / unit(placed.body);
  }
  return place;
}

const Vec3& point(const DisplayMesh& mesh, std::int32_t i) {
  return mesh.points[static_cast<std::size_t>(i)];
}

} // namespace

namespace {

std::unique_ptr<const FacetTree> tree_over(const DisplayMesh& drawing, double unit) {
  std::vector<double> points;
  for (const Vec3& p : drawing.points)
    for (const double coordinate : p)
      points.push_back(coordinate / unit);
  return make_facet_tree(points, drawing.triangles);
}

} // namespace

FacetBody::FacetBody(DisplayMesh drawing, double size)
    : drawing_(std::move(drawing)), size_(size),
      tree_(drawing_.triangles.empty() ? nullptr : tree_over(drawing_, unit(*this))) {}

namespace {

/// A segment in the circle around it.
struct Encircled {
  Segment segment;
  Vec2 middle;
  double radius;
};

std::vector<Encircled> segments(const PlacedBody& placed) {
  std::vector<Encircled> list;
  const DisplayMesh& drawing = placed.body.drawing();
  for (const auto& [from, to] : drawing.lines) {
    const Vec2 a = placed.pose.to_space(point(drawing, from)).head<2>();
    const Vec2 b = placed.pose.to_space(point(drawing, to)).head<2>();
    list.push_back({{a, b}, 0.5 * (a + b), 0.5 * (b - a).norm()});
  }
  return list;
}

/// Whether two segments are further apart than that, by their circles.
bool far(const Encircled& a, const Encircled& b, double distance) {
  const double apart = distance + a.radius + b.radius;
  return (b.middle - a.middle).squaredNorm() > apart * apart;
}

std::array<Vec3, 3> triangle(const PlacedBody& placed, int number) {
  const DisplayMesh& drawing = placed.body.drawing();
  std::array<Vec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = placed.pose.to_space(
        point(drawing, drawing.triangles[static_cast<std::size_t>(number)][i]));
  return corners;
}

double clearance_of_segments(const PlacedBody& a, const PlacedBody& b) {
  double least = infinity;
  const std::vector<Encircled> others = segments(b);
  for (const Encircled& own : segments(a))
    for (const Encircled& other : others)
      if (!far(own, other, least))
        least = std::min(least, distance(own.segment, other.segment));
  return least;
}

std::optional<Cut> deepest_cut_of_segments(const PlacedBody& a, const PlacedBody& b) {
  std::optional<Cut> deepest;
  const std::vector<Encircled> others = segments(b);
  for (const Encircled& own : segments(a))
    for (const Encircled& other : others) {
      if (far(own, other, 0.0))
        continue;
      const double depth = cut_depth(own.segment, other.segment);
      if (depth <= 0.0 || (deepest && depth <= deepest->depth))
        continue;
      const Vec2 place = crossing(own.segment, other.segment);
      deepest = Cut{depth, {place.x(), place.y(), 0.0}};
    }
  return deepest;
}

} // namespace

bool closed(const DisplayMesh& drawing) {
  TriangleMesh mesh{drawing.points, drawing.triangles};
  const Box box = box_of(drawing.points);
  constexpr double rounding = 1e-12; // the poles of a sphere are rings of that radius
  if (!mesh.triangles.empty())
    clean_up(mesh, rounding * box.size());
  std::vector<std::pair<std::int32_t, std::int32_t>> edges; // both ends of a line are one each
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  for (const auto& line : drawing.lines)
    for (const std::int32_t end : line)
      edges.emplace_back(end, end);
  std::sort(edges.begin(), edges.end());
  std::size_t uses = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    ++uses;
    if (k + 1 < edges.size() && edges[k + 1] == edges[k])
      continue;
    if (uses % 2 != 0)
      return false;
    uses = 0;
  }
  return !edges.empty();
}

double clearance(const PlacedBody& a, const PlacedBody& b) {
  if (a.body.tree() == nullptr || b.body.tree() == nullptr)
    return clearance_of_segments(a, b);
  assert(a.body.size() == b.body.size());
  const double distance = a.body.tree()->distance(place_of(a), *b.body.tree(), place_of(b));
  return std::max(distance, 0.0) * unit(a.body);
}

std::optional<Cut> deepest_cut(const PlacedBody& a, const PlacedBody& b) {
  if (a.body.tree() == nullptr || b.body.tree() == nullptr)
    return deepest_cut_of_segments(a, b);
  std::optional<Cut> deepest;
  for (const auto& [own, other] : a.body.tree()->cuts(place_of(a), *b.body.tree(), place_of(b))) {
    const TrianglePair pair(triangle(a, own), triangle(b, other));
    const double depth = pair.depth();
    // FCL counts triangles that touch to its rounding; what counts here is decided exactly.
    if (depth > (deepest ? deepest->depth : 0.0) && pair.meets())
      deepest = Cut{depth, pair.place()};
  }
  return deepest;
}

} // namespace billet::geometry
