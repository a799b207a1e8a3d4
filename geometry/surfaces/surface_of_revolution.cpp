#include "geometry/surfaces/surface_of_revolution.h"

#include "geometry/base/limits.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

// Adds the closed circle of radius r about `centre` in the plane of e1 and e2.
void add_circle(DisplayMesh& mesh, const Vec3& centre, double r, const Vec3& e1, const Vec3& e2) {
  constexpr int pieces = 4 * pieces_round; // lines are cheap, and a roll is far larger than its gap
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (int j = 0; j < pieces; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / pieces;
    mesh.points.push_back(centre + r * (std::cos(angle) * e1 + std::sin(angle) * e2));
    mesh.lines.push_back({first + j, first + (j + 1) % pieces});
  }
}

DisplayMesh section(const Axis& axis, const std::vector<Vec2>& line) {
  DisplayMesh mesh;
  const double along = axis.direction.z();
  if (std::abs(along) < 0.5) { // the axis lies in the plane: the meridian and its mirror image
    for (const double side : {1.0, -1.0}) {
      const auto first = static_cast<std::int32_t>(mesh.points.size());
      for (const Vec2& p : line)
        mesh.points.emplace_back(axis.origin + p.x() * axis.direction +
                                 side * p.y() * axis.perpendicular);
      for (std::int32_t i = 1; i < static_cast<std::int32_t>(line.size()); ++i)
        mesh.lines.push_back({first + i - 1, first + i});
    }
    return mesh;
  }
  // The axis stands on the plane: a circle wherever the meridian crosses it.
  const double height = -axis.origin.z() / along;
  const Vec3 centre = axis.origin + height * axis.direction;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 &a = line[i - 1], &b = line[i];
    if ((a.x() <= height) == (b.x() <= height))
      continue;
    const double r = a.y() + (b.y() - a.y()) * (height - a.x()) / (b.x() - a.x());
    add_circle(mesh, centre, r, Vec3::UnitX(), Vec3::UnitY());
  }
  return mesh;
}

} // namespace

Axis make_axis(const Vec3& origin, const Vec3& direction) {
  Axis axis{origin, direction.stableNormalized(), Vec3::UnitX()};
  // In the plane of a plane scene if the axis is; any fixed choice will do otherwise.
  const Vec3 in_plane = axis.direction.cross(Vec3::UnitZ());
  axis.perpendicular = in_plane.squaredNorm() > 0.25
                           ? in_plane.normalized()
                           : (Vec3::UnitX() - axis.direction.x() * axis.direction).normalized();
  return axis;
}

AxisCoordinates axis_coordinates(const Axis& axis, const Vec3& point, double size) {
  using WideVector = Eigen::Matrix<Wide, 3, 1>;
  const WideVector v = point.cast<Wide>() - axis.origin.cast<Wide>();
  const WideVector direction = axis.direction.cast<Wide>();
  const Wide h = v.dot(direction);
  const WideVector radial = v - h * direction;
  const Wide r = radial.norm();
  // Below this the direction of `radial` is rounding.
  const double little = 4.0 * epsilon * std::max(std::abs(static_cast<double>(h)), size);
  if (r <= little)
    return {h, 0.0L, axis.perpendicular};
  return {h, r, (radial / r).cast<double>()};
}

Projection revolved(const Axis& axis,
                    const Vec3& e_r,
                    const Vec3& point,
                    const MeridianPoint& at,
                    bool inside) {
  const Vec3 normal = at.n_h * axis.direction + at.n_r * e_r;
  const Vec3 tangent = at.n_h * e_r - at.n_r * axis.direction;
  const Vec3 hoop = axis.direction.cross(e_r);
  const double sign = inside ? -1.0 : 1.0;
  Projection p;
  p.gap = sign * at.gap;
  p.foot = point - at.gap * normal;
  p.normal = sign * normal;
  p.dnormal_dx =
      sign * (at.k_meridian * tangent * tangent.transpose() + at.k_hoop * hoop * hoop.transpose());
  return p;
}

std::pair<double, double> heights(const Axis& axis, const Box& window) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 x((corner & 1) != 0 ? window.high.x() : window.low.x(),
                 (corner & 2) != 0 ? window.high.y() : window.low.y(),
                 (corner & 4) != 0 ? window.high.z() : window.low.z());
    const double h = (x - axis.origin).dot(axis.direction);
    low = std::min(low, h);
    high = std::max(high, h);
  }
  return {low, high};
}

DisplayMesh
revolved_display(const Axis& axis, const std::vector<Vec2>& line, bool planar, bool inside) {
  if (planar)
    return section(axis, line);
  DisplayMesh mesh;
  const Vec3 e1 = axis.perpendicular, e2 = axis.direction.cross(e1);
  for (const Vec2& p : line)
    for (int j = 0; j < pieces_round; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / pieces_round;
      mesh.points.emplace_back(axis.origin + p.x() * axis.direction +
                               p.y() * (std::cos(angle) * e1 + std::sin(angle) * e2));
    }
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    mesh.triangles.push_back(inside ? std::array{a, b, c} : std::array{a, c, b});
  };
  // A ring of radius zero is one point, its first, and half of each quadrilateral there has no
  // area.
  const auto corner = [&](std::int32_t ring, std::int32_t j) {
    const bool pole = line[static_cast<std::size_t>(ring)].y() == 0.0;
    return ring * pieces_round + (pole ? 0 : j % pieces_round);
  };
  for (std::int32_t i = 1; i < static_cast<std::int32_t>(line.size()); ++i)
    for (std::int32_t j = 0; j < pieces_round; ++j) {
      const std::int32_t a = corner(i - 1, j), a_next = corner(i - 1, j + 1);
      const std::int32_t b = corner(i, j), b_next = corner(i, j + 1);
      if (a != a_next)
        add(a, a_next, b_next);
      if (b != b_next)
        add(a, b_next, b);
    }
  return mesh;
}

Vec3 disk_extent(const Axis& axis) {
  return (1.0 - axis.direction.array().square()).max(0.0).sqrt().matrix();
}

} // namespace billet::geometry
