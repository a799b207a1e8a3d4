#include "geometry/collision/narrow_parts.h"

#include "geometry/base/limits.h"
#include "geometry/triangles/edge_table.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace billet::geometry {

namespace {

/// A triangle at an edge.
struct EdgeSide {
  Vec3 normal;   ///< unit
  Vec3 opposite; ///< corner that is not on the edge
  double height; ///< of that corner over the edge [mm]
};

class NarrowEdges {
public:
  NarrowEdges(const TriangleMesh& mesh, const NarrowSearch& search)
      : mesh_(mesh), search_(search), taken_(mesh.points.size(), 0) {
    search_.window.low.array() -= search.step(); // for rounding, and for what is on its faces
    search_.window.high.array() += search.step();
  }

  std::vector<InnerBall> find() {
    for_each_edge(edge_uses(mesh_), [&](std::span<const EdgeUse> uses) {
      if (uses.size() == 2) // at a rim an open surface ends
        look(uses[0], uses[1]);
    });
    for (std::size_t i = 0; i < taken_.size(); ++i)
      if (taken_[i] != 0 && search_.window.contains(mesh_.points[i]))
        balls_.push_back({mesh_.points[i], 0.0});
    return balls_;
  }

private:
  [[nodiscard]] const Vec3& point(std::int32_t i) const {
    return mesh_.points[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] EdgeSide side(const EdgeUse& use) const {
    const auto& corners = mesh_.triangles[static_cast<std::size_t>(use.triangle)];
    const Vec3 &a = point(use.low), &b = point(use.high);
    const Vec3& c = point(corners[static_cast<std::size_t>((use.side + 2) % 3)]);
    const Vec3 area = (use.forward ? 1.0 : -1.0) * (b - a).cross(c - a);
    const double length = (b - a).norm();
    return {area.stableNormalized(), c, length > 0.0 ? area.norm() / length : 0.0};
  }

  /// Takes an edge that is convex and sharp, or part of a rounding that is narrow.
  void look(const EdgeUse& one, const EdgeUse& other) {
    const EdgeSide left = side(one), right = side(other);
    const Vec3 from_edge = right.opposite - point(one.low);
    if (left.normal.dot(from_edge) >= 0.0) // hollow, or flat
      return;
    const double turn = std::acos(std::clamp(left.normal.dot(right.normal), -1.0, 1.0));
    // Normals of facets on a rounding stand at their middles, a third of a height from the edge.
    const double radius = (left.height + right.height) / (3.0 * turn);
    if (turn < sharp_turn && !(radius < search_.width))
      return;
    for (const std::int32_t end : {one.low, one.high})
      taken_[static_cast<std::size_t>(end)] = 1;
    add_along(point(one.low), point(one.high));
  }

  /// Adds balls at even steps between two points, where these lie in the window.
  void add_along(const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    double first = 0.0, last = 1.0; // shares of the way that are in the window
    for (int d = 0; d < 3; ++d) {
      if (way[d] == 0.0) {
        if (from[d] < search_.window.low[d] || from[d] > search_.window.high[d])
          return;
        continue;
      }
      const double a = (search_.window.low[d] - from[d]) / way[d];
      const double b = (search_.window.high[d] - from[d]) / way[d];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    const double parts = std::ceil(way.norm() / search_.step());
    for (double i = std::max(1.0, std::ceil(first * parts)); i < parts && i <= last * parts; ++i)
      balls_.push_back({from + i / parts * way, 0.0});
  }

  const TriangleMesh& mesh_;
  NarrowSearch search_;
  std::vector<char> taken_; ///< points, one flag each
  std::vector<InnerBall> balls_;
};

} // namespace

std::vector<InnerBall> narrow_parts(const TriangleMesh& mesh, const NarrowSearch& search) {
  return NarrowEdges(mesh, search).find();
}

void add_around(const CircleOfBalls& circle,
                const NarrowSearch& search,
                std::vector<InnerBall>& balls) {
  if (circle.radius == 0.0) {
    balls.push_back({circle.centre, circle.of_balls});
    return;
  }
  const Vec3 middle = 0.5 * (search.window.low + search.window.high) - circle.centre;
  const Vec3 across = middle - middle.dot(circle.axis) * circle.axis;
  const double reach = 0.5 * search.window.size() + circle.of_balls;
  const Vec3 e1 = across.norm() > epsilon * circle.radius ? Vec3(across.normalized())
                                                          : circle.axis.unitOrthogonal();
  const Vec3 e2 = circle.axis.cross(e1);
  // Of the circle, no more than what the window's ball is seen under from the axis.
  const double angle = across.norm() > reach ? std::asin(reach / across.norm()) : std::numbers::pi;
  const auto steps = static_cast<int>(std::ceil(angle * circle.radius / search.step()));
  for (int i = -steps; i <= steps; ++i) {
    const double at = steps > 0 ? angle * i / steps : 0.0;
    balls.push_back(
        {circle.centre + circle.radius * (std::cos(at) * e1 + std::sin(at) * e2), circle.of_balls});
  }
}

} // namespace billet::geometry
