#include "geometry/surface_check.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/surface_of_revolution.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

// A circle about (0, major). As major > minor the half of the meridian with r >= 0 is always
// nearer to a point with r >= 0 than its mirror image. (G.7)
struct Circle {
  double major;
  double minor;

  [[nodiscard]] MeridianPoint at(Wide h, Wide r) const {
    const Wide distance = std::hypot(h, r - major);
    const auto gap = static_cast<double>(distance - minor);
    const auto d = static_cast<double>(distance);
    if (d <= 4.0 * std::numeric_limits<double>::epsilon() * major)
      return {gap, 0.0, 1.0, 0.0, 1.0 / major};
    const auto n_r = static_cast<double>((r - major) / distance);
    const double hoop = r > 0.0 ? n_r / static_cast<double>(r) : 0.0;
    return {gap, static_cast<double>(h / distance), n_r, 1.0 / d, hoop};
  }
  [[nodiscard]] double size() const { return major; }
  [[nodiscard]] Box bounds(const Axis& axis) const {
    const Vec3 half = major * disk_extent(axis) + Vec3::Constant(minor);
    Box box;
    box.add(axis.origin - half);
    box.add(axis.origin + half);
    return box;
  }
  [[nodiscard]] std::vector<MeridianBall>
  narrow(double /*low*/, double /*high*/, double width) const {
    return minor < width ? std::vector<MeridianBall>{{0.0, major, minor}}
                         : std::vector<MeridianBall>{};
  }
  [[nodiscard]] std::vector<Vec2> line(double /*low*/, double /*high*/) const {
    std::vector<Vec2> line;
    for (int i = 0; i <= pieces_round; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i % pieces_round) / pieces_round;
      line.emplace_back(minor * std::cos(angle), major + minor * std::sin(angle));
    }
    return line;
  }
};

} // namespace

SurfacePtr
make_torus(const Vec3& centre, const Vec3& axis, double major, double minor, bool inside) {
  require_point(centre, "centre of the torus");
  require_direction(axis, "axis of the torus");
  require_between(major, 0.0, std::numeric_limits<double>::infinity(), "major of the torus");
  require_between(minor, 0.0, major, "minor of the torus");
  return std::make_unique<const RevolvedSurface<Circle>>(make_axis(centre, axis),
                                                         Circle{major, minor}, inside);
}

} // namespace billet::geometry
