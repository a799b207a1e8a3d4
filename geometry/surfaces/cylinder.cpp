#include "geometry/base/limits.h"
#include "geometry/surface_check.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/surface_of_revolution.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

namespace billet::geometry {

namespace {

// r = radius. (G.4)
struct StraightLine {
  double radius;

  [[nodiscard]] MeridianPoint at(Wide /*h*/, Wide r) const {
    const double hoop = r > 0.0 ? 1.0 / static_cast<double>(r) : 0.0;
    return {static_cast<double>(r - radius), 0.0, 1.0, 0.0, hoop};
  }
  [[nodiscard]] double size() const { return radius; }
  [[nodiscard]] Box bounds(const Axis& axis) const {
    Vec3 half = radius * disk_extent(axis);
    for (int i = 0; i < 3; ++i)
      if (axis.direction[i] != 0.0)
        half[i] = infinity;
    Box box;
    box.low = axis.origin - half;
    box.high = axis.origin + half;
    return box;
  }
  [[nodiscard]] std::vector<MeridianBall> narrow(double low, double high, double width) const {
    if (!(radius < width))
      return {};
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

// The section of a bar, which has no thickness.
class Circle final : public RigidSurface {
public:
  Circle(const Vec3& centre, double radius, bool inside)
      : bar_(make_axis(centre, Vec3::UnitZ()), StraightLine{radius}, inside), centre_(centre),
        radius_(radius), inside_(inside) {}

  [[nodiscard]] Box bounds() const override {
    const Vec3 half(radius_, radius_, 0.0);
    return {centre_ - half, centre_ + half};
  }
  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override {
    return bar_.display(window, planar);
  }
  // A quarter each. (G.56)
  [[nodiscard]] std::vector<ToolCorner> corners(double /*angle*/) const override {
    std::vector<ToolCorner> corners;
    const auto normal = [](int eighths) {
      const double angle = 0.25 * std::numbers::pi * eighths;
      return Vec3(std::cos(angle), std::sin(angle), 0.0);
    };
    for (int eighths = 1; eighths < 8 && !inside_; eighths += 2)
      corners.push_back({centre_, radius_, normal(eighths), normal(eighths + 2)});
    return corners;
  }
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override {
    if (inside_ || !(radius_ < search.width))
      return {};
    return {{centre_, radius_}};
  }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override {
    bar_.project(points, reach, out);
  }

  RevolvedSurface<StraightLine> bar_;
  Vec3 centre_;
  double radius_;
  bool inside_;
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
  return std::make_unique<const Circle>(Vec3(centre.x(), centre.y(), 0.0), radius, inside);
}

} // namespace billet::geometry
