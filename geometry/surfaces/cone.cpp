#include "geometry/base/limits.h"
#include "geometry/surface_check.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/surface_of_revolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::geometry {

namespace {

// The ray from (0, 0) along (cos, sin); the solid lies between it and the axis. (G.6)
struct Ray {
  double cos;
  double sin;

  [[nodiscard]] MeridianPoint at(Wide wide_h, Wide wide_r) const {
    const auto h = static_cast<double>(wide_h), r = static_cast<double>(wide_r);
    if (h * cos + r * sin > 0.0) {
      const double n_r = cos;
      return {static_cast<double>(wide_r * cos - wide_h * sin), -sin, n_r, 0.0,
              r > 0.0 ? n_r / r : 0.0};
    }
    const double d = std::hypot(h, r); // behind the apex, which is the closest point
    if (d > 0.0)
      return {d, h / d, r / d, 1.0 / d, 1.0 / d};
    return {0.0, -1.0, 0.0, 0.0, 0.0};
  }
  [[nodiscard]] double size() const { return 0.0; } // a cone has no length of its own
  [[nodiscard]] Box bounds(const Axis& axis) const {
    Box box;
    box.add(axis.origin);
    const double half_angle = std::atan2(sin, cos);
    for (int i = 0; i < 3; ++i) {
      // The generator closest to a coordinate direction decides whether the cone is endless in it.
      const double angle = std::acos(std::clamp(axis.direction[i], -1.0, 1.0));
      if (angle - half_angle < 0.5 * std::numbers::pi)
        box.high[i] = infinity;
      if (std::numbers::pi - angle - half_angle < 0.5 * std::numbers::pi)
        box.low[i] = -infinity;
    }
    return box;
  }
  [[nodiscard]] std::vector<MeridianBall> narrow(double low, double high, double width) const {
    std::vector<MeridianBall> balls;
    if (low <= 0.0 && high >= 0.0)
      balls.push_back({0.0, 0.0, 0.0});
    const double from = std::max(0.0, low), to = std::min(high, width / sin);
    const auto steps = static_cast<int>(std::ceil(4.0 * std::max(0.0, to - from) / width));
    for (int i = 1; i <= steps; ++i) {
      const double h = from + (to - from) * i / steps;
      balls.push_back({h, 0.0, h * sin});
    }
    return balls;
  }
  [[nodiscard]] std::vector<Vec2> line(double /*low*/, double high) const {
    if (high <= 0.0)
      return {};
    return {{high, high * sin / cos}, {0.0, 0.0}};
  }
};

} // namespace

SurfacePtr make_cone(const Vec3& apex, const Vec3& axis, double half_angle, bool inside) {
  require_point(apex, "apex of the cone");
  require_direction(axis, "axis of the cone");
  require_between(half_angle, 0.0, 0.5 * std::numbers::pi, "half angle of the cone [rad]");
  return std::make_unique<const RevolvedSurface<Ray>>(
      make_axis(apex, axis), Ray{std::cos(half_angle), std::sin(half_angle)}, inside);
}

} // namespace billet::geometry
