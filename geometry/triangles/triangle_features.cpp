#include "geometry/triangles/triangle_features.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/edge_table.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace billet::geometry {

namespace {

constexpr double border_slack = 1e-9; // share of the size by which a point may overshoot a border
constexpr double no_overshoot = -std::numeric_limits<double>::infinity();

// Sums of unit normals shorter than this have cancelled: a fin without thickness.
constexpr double cancelled = 1e-12;

Vec3 unit_or(const Vec3& sum, const Vec3& fallback) {
  const double length = sum.norm();
  return length > cancelled ? Vec3(sum / length) : fallback;
}

} // namespace

TriangleFeatures::TriangleFeatures(const TriangleMesh& mesh) : mesh_(mesh) {
  for (const Vec3& p : mesh_.points)
    bounds_.add(p);
  const double largest =
      std::max(bounds_.low.cwiseAbs().maxCoeff(), bounds_.high.cwiseAbs().maxCoeff());
  rounding_ = 16.0 * std::numeric_limits<double>::epsilon() * largest;
  find_normals();
  find_edges();
}

// Unit normals of faces and angle-weighted ones of vertices. (G.14)
void TriangleFeatures::find_normals() {
  std::vector<Vec3> sums(mesh_.points.size(), Vec3::Zero());
  std::vector<Vec3> any(mesh_.points.size(), Vec3::UnitX());
  for (const std::array<std::int32_t, 3>& t : mesh_.triangles) {
    const std::array<Vec3, 3> side{point(t[1]) - point(t[0]), point(t[2]) - point(t[1]),
                                   point(t[0]) - point(t[2])};
    const Vec3 normal = side[0].cross(side[1]).stableNormalized();
    face_normals_.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = static_cast<std::size_t>(t[i]);
      sums[v] += angle_between(side[i], -side[(i + 2) % 3]) * normal;
      any[v] = normal;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v)
    vertex_normals_.push_back(unit_or(sums[v], any[v]));
}

void TriangleFeatures::find_edges() {
  triangle_edges_.resize(mesh_.triangles.size());
  neighbours_.resize(mesh_.triangles.size(), {-1, -1, -1});
  for_each_edge(edge_uses(mesh_), [&](std::span<const EdgeUse> uses) {
    const auto number = static_cast<std::int32_t>(edges_.size());
    Vec3 sum = Vec3::Zero();
    for (const EdgeUse& use : uses) {
      const auto t = static_cast<std::size_t>(use.triangle);
      triangle_edges_[t][static_cast<std::size_t>(use.side)] = number;
      sum += face_normals_[t];
      if (uses.size() == 2)
        neighbours_[t][static_cast<std::size_t>(use.side)] =
            uses[&use == uses.data() ? 1 : 0].triangle;
    }
    const Vec3& first = face_normals_[static_cast<std::size_t>(uses[0].triangle)];
    Edge edge{uses[0].low, uses[0].high, unit_or(sum, first), uses.size() == 1, Vec3::Zero()};
    if (edge.border) {
      const Vec3 way = (uses[0].forward ? 1.0 : -1.0) * (point(edge.b) - point(edge.a));
      edge.outward = way.cross(first).stableNormalized();
      rim_.emplace_back(edge.a, number);
      rim_.emplace_back(edge.b, number);
    }
    edges_.push_back(edge);
  });
  std::sort(rim_.begin(), rim_.end());
}

ClosestFeature TriangleFeatures::closest(std::int32_t triangle, const Vec3& x) const {
  const auto t = static_cast<std::size_t>(triangle);
  const std::array<std::int32_t, 3>& corners = mesh_.triangles[t];
  const Vec3& normal = face_normals_[t];
  ClosestFeature best{std::numeric_limits<double>::infinity(), Feature::face, triangle};
  bool beside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = point(corners[i]);
    const Vec3 way = point(corners[(i + 1) % 3]) - from;
    if (normal.dot(way.cross(x - from)) >= 0.0)
      continue;
    // The closest point lies on a side that has x on its far side.
    beside = true;
    const ClosestFeature candidate = closest_on_edge(triangle_edges_[t][i], x);
    if (candidate.distance2 < best.distance2)
      best = candidate;
  }
  if (beside)
    return best;
  const double height = (x - point(corners[0])).dot(normal);
  return {height * height, Feature::face, triangle};
}

Inside TriangleFeatures::inside(std::int32_t triangle, const Vec3& x) const {
  const auto t = static_cast<std::size_t>(triangle);
  const std::array<std::int32_t, 3>& corners = mesh_.triangles[t];
  Inside inside{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = point(corners[i]);
    const Vec3 way = point(corners[(i + 1) % 3]) - from;
    const double distance = face_normals_[t].dot(way.cross(x - from)) / way.norm();
    if (distance < inside.distance)
      inside = {distance, i};
  }
  return inside;
}

ClosestFeature TriangleFeatures::closest_on_edge(std::int32_t edge, const Vec3& x) const {
  const Edge& e = edges_[static_cast<std::size_t>(edge)];
  const Vec3 way = point(e.b) - point(e.a), v = x - point(e.a);
  const double along = v.dot(way), length2 = way.squaredNorm();
  if (along <= 0.0)
    return {v.squaredNorm(), Feature::vertex, e.a};
  if (along >= length2)
    return {(x - point(e.b)).squaredNorm(), Feature::vertex, e.b};
  return {(v - along / length2 * way).squaredNorm(), Feature::edge, edge};
}

Projection TriangleFeatures::project(const ClosestFeature& closest, const Vec3& x) const {
  const auto number = static_cast<std::size_t>(closest.number);
  if (closest.feature == Feature::edge)
    return on_edge(edges_[number], x);
  if (closest.feature == Feature::vertex)
    return on_vertex(closest.number, x);
  Projection p;
  p.normal = face_normals_[number];
  p.gap = (x - point(mesh_.triangles[number][0])).dot(p.normal);
  p.foot = x - p.gap * p.normal;
  return p;
}

Projection TriangleFeatures::on_edge(const Edge& edge, const Vec3& x) const {
  const Vec3 way = point(edge.b) - point(edge.a), along = way.normalized();
  const Vec3 from = x - point(edge.a), v = from - from.dot(way) / way.squaredNorm() * way;
  return around(x, v, edge.normal, Mat3::Identity() - along * along.transpose(),
                edge.border ? v.dot(edge.outward) : no_overshoot);
}

Projection TriangleFeatures::on_vertex(std::int32_t vertex, const Vec3& x) const {
  const Vec3 v = x - point(vertex);
  double overshoot = no_overshoot;
  const auto first = std::lower_bound(rim_.begin(), rim_.end(), std::pair(vertex, 0));
  for (auto it = first; it != rim_.end() && it->first == vertex; ++it)
    overshoot = std::max(overshoot, v.dot(edges_[static_cast<std::size_t>(it->second)].outward));
  return around(x, v, vertex_normals_[static_cast<std::size_t>(vertex)], Mat3::Identity(),
                overshoot);
}

Projection TriangleFeatures::around(const Vec3& x,
                                    const Vec3& v,
                                    const Vec3& pseudo_normal,
                                    const Mat3& free,
                                    double overshoot) const {
  const double distance = v.norm(), height = v.dot(pseudo_normal);
  const bool border = overshoot > no_overshoot, behind = height < 0.0;
  Projection p;
  if (border && behind && overshoot > border_slack * bounds_.size())
    return p;
  if (distance <= rounding_ || (border && behind)) {
    p.gap = height; // the direction of v is rounding, or the sheet ends exactly here
    p.normal = pseudo_normal;
  } else {
    const double sign = behind ? -1.0 : 1.0;
    const Vec3 unit = v / distance;
    p.gap = sign * distance;
    p.normal = sign * unit;
    p.dnormal_dx = sign / distance * (free - unit * unit.transpose());
  }
  p.foot = x - p.gap * p.normal;
  return p;
}

} // namespace billet::geometry
