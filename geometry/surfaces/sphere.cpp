#include "geometry/surface_check.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/surface_of_revolution.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

// h^2 + r^2 = radius^2. (G.5)
struct HalfCircle {
  double radius;

  [[nodiscard]] MeridianPoint at(Wide h, Wide r) const {
    const Wide distance = std::hypot(h, r);
    const auto gap = static_cast<double>(distance - radius);
    const auto d = static_cast<double>(distance);
    if (d <= 4.0 * std::numeric_limits<double>::epsilon() * radius)
      return {gap, 0.0, 1.0, 0.0, 0.0}; // at the centre every direction is as good
    return {gap, static_cast<double>(h / distance), static_cast<double>(r / distance), 1.0 / d,
            1.0 / d};
  }
  [[nodiscard]] double size() const { return radius; }
  [[nodiscard]] Box bounds(const Axis& axis) const {
    Box box;
    box.add(axis.origin - Vec3::Constant(radius));
    box.add(axis.origin + Vec3::Constant(radius));
    return box;
  }
  [[nodiscard]] std::vector<MeridianBall>
  narrow(double /*low*/, double /*high*/, double width) const {
    return radius < width ? std::vector<MeridianBall>{{0.0, 0.0, radius}}
                          : std::vector<MeridianBall>{};
  }
  [[nodiscard]] std::vector<Vec2> line(double /*low*/, double /*high*/) const {
    constexpr int pieces = pieces_round / 2;
    std::vector<Vec2> line{{radius, 0.0}};
    for (int i = 1; i < pieces; ++i) {
      const double angle = std::numbers::pi * i / pieces;
      line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    line.emplace_back(-radius, 0.0);
    return line;
  }
};

} // namespace

SurfacePtr make_sphere(const Vec3& centre, double radius, bool inside) {
  require_point(centre, "centre of the sphere");
  require_between(radius, 0.0, std::numeric_limits<double>::infinity(), "radius of the sphere");
  return std::make_unique<const RevolvedSurface<HalfCircle>>(make_axis(centre, Vec3::UnitZ()),
                                                             HalfCircle{radius}, inside);
}

} // namespace billet::geometry
