#include "geometry/mesh3d/wall_widths.h"

#include "geometry/surfaces/triangle_surface.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>
#include <span>

namespace billet::geometry {

namespace {

/// The two places where a ball touches lie opposite to each other, seen from its middle, if the
/// cosine between them is below this: 140 degrees. Else it sits in an edge.
constexpr double opposite = -0.766;

/// A ball that shrinks by less than this has its size.
constexpr double converged = 1e-3;
/// Places nearer to each other than this share of the widest gap are the same.
constexpr double same = 1e-9;
constexpr int most_rounds_of_balls = 30;

/// Diameter of the largest ball in the direction n that touches at x and again opposite to it.
std::optional<double>
ball_at(const RigidSurface& surface, const Vec3& x, const Vec3& n, double most) {
  double radius = 0.5 * most;
  std::optional<Vec3> beyond; // where else the ball touches
  for (int round = 0; round < most_rounds_of_balls; ++round) {
    const Vec3 middle = x + radius * n;
    Projection foot;
    surface.project(std::span(&middle, 1), 2.0 * radius, std::span(&foot, 1));
    const Vec3 way = foot.foot - x;
    if (!foot.found() || way.norm() < same * most)
      break; // the ball touches at x only
    if (way.dot(n) <= 0.0)
      return std::nullopt; // rounding
    const double smaller = 0.5 * way.squaredNorm() / way.dot(n);
    if (smaller > (1.0 - converged) * radius)
      break;
    beyond = foot.foot;
    radius = smaller;
  }
  if (!beyond)
    return std::nullopt; // wider than asked for
  const double cosine = (*beyond - (x + radius * n)).normalized().dot(-n);
  return cosine < opposite ? std::optional(2.0 * radius) : std::nullopt;
}

} // namespace

std::vector<WallWidth> wall_widths(const TriangleMesh& mesh, double most) {
  const SurfacePtr surface = make_triangle_surface(mesh);
  std::vector<WallWidth> widths;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const Vec3 middle =
        (corner(mesh, triangle, 0) + corner(mesh, triangle, 1) + corner(mesh, triangle, 2)) / 3.0;
    const Vec3 doubled = doubled_area(mesh, triangle), normal = doubled.stableNormalized();
    for (const double side : {-1.0, 1.0})
      if (const std::optional<double> width = ball_at(*surface, middle, side * normal, most))
        widths.push_back(
            {static_cast<std::int32_t>(t), middle, *width, 0.5 * doubled.norm(), side > 0.0});
  }
  return widths;
}

} // namespace billet::geometry
