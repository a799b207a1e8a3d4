#include "geometry/curved/boundary_surface.h"

#include "geometry/base/index.h"
#include "geometry/triangles/nearest_in_triangle.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

/// Edges whose normals differ by more are sharp.
constexpr double sharp_turn = std::numbers::pi / 6.0;
/// The same of edges that are said to be smooth: beyond, the surface could fold.
constexpr double crease_turn = 5.0 * std::numbers::pi / 12.0;

CornerNormals normals_of(const SolidBoundary& boundary) {
  return boundary.creases ? corner_normals(boundary.mesh, crease_turn, *boundary.creases)
                          : corner_normals(boundary.mesh, sharp_turn);
}

constexpr double least_patch_cosine =
    0.5; // of a normal against its facet; below, the patch may fold
constexpr double most_departure =
    0.15; // of a curved triangle from its facet, over its longest side

} // namespace

BoundarySurface::BoundarySurface(const SolidBoundary& boundary, double short_crease)
    : boundary_(&boundary), normals_(normals_of(boundary)),
      edges_(edge_curves(boundary.mesh, normals_)),
      lines_(feature_lines(boundary, normals_, short_crease)), members_(idx(lines_.n_patches)) {
  const TriangleMesh& mesh = boundary.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    curved_.push_back(curved_triangle(mesh, edges_, t));
    is_curved_.push_back(static_cast<char>(is_curved(t)));
    members_[idx(lines_.patch[t])].push_back(static_cast<std::int32_t>(t));
  }
  for (const std::vector<std::int32_t>& patch : members_) {
    std::vector<Box> boxes;
    for (const std::int32_t t : patch) {
      Box& box = boxes.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        box.add(corner(mesh, mesh.triangles[idx(t)], i));
    }
    trees_.emplace_back(boxes);
  }
}

bool BoundarySurface::is_curved(std::size_t t) const {
  const std::array<std::int32_t, 3>& triangle = boundary_->mesh.triangles[t];
  bool flat = true;
  for (std::size_t i = 0; i < 3; ++i) {
    flat = flat && normals_.corners[t][i] == normals_.faces[t];
    const EdgeCurve& side = curve(static_cast<std::int32_t>(t), static_cast<std::int32_t>(i));
    flat = flat && (side.straight || side.kind != EdgeKind::smooth);
  }
  if (flat)
    return false;
  const CurvedTriangle::Shape shape = curved_[t].shape();
  return shape.least_cosine > least_patch_cosine &&
         shape.departure < most_departure * shape_of(boundary_->mesh, triangle).longest;
}

const EdgeCurve& BoundarySurface::curve(std::int32_t triangle, std::int32_t side) const {
  return edges_.curves[idx(edges_.of_triangle[idx(triangle)][idx(side)])];
}

const LinePiece& BoundarySurface::piece(const LinePlace& place) const {
  return lines_.chains[idx(place.line)][idx(place.piece)];
}

SurfacePlace BoundarySurface::place(std::int32_t patch, const Vec3& x) const {
  const std::vector<std::int32_t>& members = members_[idx(patch)];
  SurfacePlace best;
  double least = std::numeric_limits<double>::infinity();
  std::int32_t first = std::numeric_limits<std::int32_t>::max();
  trees_[idx(patch)].walk(x, least, [&](std::int32_t i) {
    const std::int32_t t = members[idx(i)];
    const TriangleMesh& mesh = boundary_->mesh;
    const auto& triangle = mesh.triangles[idx(t)];
    const Vec3 &a = corner(mesh, triangle, 0), &b = corner(mesh, triangle, 1),
               &c = corner(mesh, triangle, 2);
    const std::array<double, 3> l = nearest_in_triangle(a, b, c, x);
    const double distance2 = (l[0] * a + l[1] * b + l[2] * c - x).squaredNorm();
    if (distance2 < least || (distance2 == least && t < first)) {
      least = distance2;
      first = t;
      best = {t, l[1], l[2]};
    }
    return least;
  });
  return best;
}

LinePlace BoundarySurface::place_on_line(std::int32_t line, const Vec3& x) const {
  LinePlace best{line, 0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  const std::vector<LinePiece>& chain = lines_.chains[idx(line)];
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Vec3& a = boundary_->mesh.points[idx(chain[i].ends[0])];
    const Vec3& b = boundary_->mesh.points[idx(chain[i].ends[1])];
    const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double distance2 = (a + t * (b - a) - x).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      best = {line, static_cast<std::int32_t>(i), t};
    }
  }
  return best;
}

SurfacePlace BoundarySurface::on_triangle(const LinePlace& place) const {
  const LinePiece& on = piece(place);
  const auto& triangle = boundary_->mesh.triangles[idx(on.triangle)];
  const std::size_t first = idx(on.side), second = (first + 1) % 3;
  std::array<double, 3> l{};
  l[triangle[first] == on.ends[0] ? first : second] = 1.0 - place.t;
  l[triangle[first] == on.ends[0] ? second : first] = place.t;
  return {on.triangle, l[1], l[2]};
}

Vec3 BoundarySurface::point(const SurfacePlace& place) const {
  if (is_curved_[idx(place.triangle)] == 0)
    return flat_point(place);
  return curved_[idx(place.triangle)].at(place.v, place.w).position;
}

Vec3 BoundarySurface::point(const LinePlace& place) const {
  const LinePiece& on = piece(place);
  const EdgeCurve& along = curve(on.triangle, on.side);
  if (place.t == 0.0 || place.t == 1.0)
    return boundary_->mesh.points[idx(on.ends[place.t == 0.0 ? 0 : 1])];
  const Vec3& a = boundary_->mesh.points[idx(on.ends[0])];
  const Vec3& b = boundary_->mesh.points[idx(on.ends[1])];
  Vec3 chord = a + place.t * (b - a);
  if (along.straight)
    return chord;
  const Vec3 point = along.at(along.ends[0] == on.ends[0] ? place.t : 1.0 - place.t).position;
  return (point - chord).norm() < most_departure * (b - a).norm() ? point : chord;
}

Vec3 BoundarySurface::flat_point(const SurfacePlace& place) const {
  const auto& triangle = boundary_->mesh.triangles[idx(place.triangle)];
  const Vec3& a = corner(boundary_->mesh, triangle, 0);
  // So that planes across an axis are kept to the bit.
  return a + place.v * (corner(boundary_->mesh, triangle, 1) - a) +
         place.w * (corner(boundary_->mesh, triangle, 2) - a);
}

double BoundarySurface::curvature(std::int32_t triangle) const {
  const std::size_t t = idx(triangle);
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (normals_.is_tip[t][i] != 0 || normals_.is_tip[t][j] != 0)
      continue;
    const auto& corners = boundary_->mesh.triangles[t];
    const double length =
        (corner(boundary_->mesh, corners, j) - corner(boundary_->mesh, corners, i)).norm();
    largest = std::max(largest, (normals_.corners[t][j] - normals_.corners[t][i]).norm() / length);
  }
  return largest;
}

} // namespace billet::geometry
