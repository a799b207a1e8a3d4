#include "geometry/analytic_surfaces.h"
#include "geometry/base/limits.h"
#include "geometry/surface_check.h"
#include "geometry/surface_of_revolution.h"

#include <cmath>

namespace billet::geometry {

namespace {

// r = radius. (G.4)
struct StraightLine {
  double radius;
  bool flat = false; // of a scene in the plane: the box has no thickness

  [[nodiscard]] MeridianPoint at(Wide /*h*/, Wide r) const {
    const double hoop = r > 0.0 ? 1.0 / static_cast<double>(r) : 0.0;
    return {static_cast<double>(r - radius), 0.0, 1.0, 0.0, hoop};
  }
  [[nodiscard]] double size() const { return radius; }
  [[nodiscard]] Box bounds(const Axis& axis) const {
    Vec3 half = radius * disk_extent(axis);
    for (int i = 0; i < 3; ++i)
      if (axis.direction[i] != 0.0 && !flat)
        half[i] = infinity;
    Box box;
    box.low = axis.origin - half;
    box.high = axis.origin + half;
    return box;
  }
  [[nodiscard]] std::vector<MeridianBall> rounds() const {
    return flat ? std::vector<MeridianBall>{{0.0, 0.0, radius}} : std::vector<MeridianBall>{};
  }
  [[nodiscard]] std::vector<MeridianBall> narrow(double low, double high, double width) const {
    if (!(radius < width))
      return {};
    if (flat)
      return {{0.0, 0.0, radius}};
    const auto steps = static_cast<int>(std::ceil(4.0 * (high - low) / width));
    std::vector<MeridianBall> balls;
    for (int i = 0; i <= steps; ++i)
      balls.push_back({low + (high - low) * i / steps, 0.0, radius});
    return balls;
  }
  [[nodiscard]] std::vector<Vec2> line(double low, double high) const {
    return {{high, radius}, {low, radius}};
  }
};

} // namespace

SurfacePtr make_cylinder(const Vec3& point, const Vec3& axis, double radius, bool inside) {
  require_point(point, "point of the cylinder");
  require_direction(axis, "axis of the cylinder");
  require_between(radius, 0.0, infinity, "radius of the cylinder");
  return std::make_unique<const RevolvedSurface<StraightLine>>(make_axis(point, axis),
                                                               StraightLine{radius}, inside);
}

SurfacePtr make_circle(const Vec3& centre, double radius, bool inside) {
  require_point(centre, "centre of the circle");
  require_between(radius, 0.0, infinity, "radius of the circle");
  const Vec3 in_plane(centre.x(), centre.y(), 0.0);
  return std::make_unique<const RevolvedSurface<StraightLine>>(make_axis(in_plane, Vec3::UnitZ()),
                                                               StraightLine{radius, true}, inside);
}

} // namespace billet::geometry
