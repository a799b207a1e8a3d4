// Random outlines with slits, spikes and bowed sides.

#pragma once

#include "geometry/base/angle.h"
#include "geometry/mesh2d/domain_remesher.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace billet::geometry {

/// Stars of random corners with slits (half as wide as given), spikes of 15 to 40
/// degrees, sides bowed in or out, middles off the middle.
class RandomOutline {
public:
  explicit RandomOutline(unsigned seed, double narrowest = 1e-6, double widest = 0.1)
      : random_(seed), narrowest_(narrowest), widest_(widest) {}

  SideLoop loop() {
    const std::vector<Vec2> corners = star();
    const double size = from(0.4, 2.0), bow = from(0.0, 1.0) < 0.5 ? 0.08 : 0.0;
    SideLoop result;
    std::int32_t part = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const bool radial = std::abs(cross(a, b)) < 0.05 * a.norm() * b.norm();
      const Vec2 sag = (radial ? 0.0 : from(-bow, bow)) * Vec2(a.y() - b.y(), b.x() - a.x());
      const double off = from(-0.15, 0.15);
      const int sides = static_cast<int>(std::ceil((b - a).norm() / size));
      for (int k = 0; k < sides; ++k) {
        const auto x = [&](double t) { return Vec2(a + t * (b - a) + 4 * t * (1 - t) * sag); };
        result.corners.push_back(x(1.0 * k / sides));
        result.middles.push_back(x((k + 0.5 + off) / sides));
        result.part.push_back(from(0.0, 8.0) < 1.0 ? ++part : part);
        result.keep.push_back(0);
        result.hold.push_back(from(0.0, 3.0) < 1.0 ? 1 : 0);
      }
    }
    return result;
  }

private:
  double from(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::vector<Vec2> star() {
    std::vector<double> ends{0.0};
    const int corners = static_cast<int>(from(5.0, 17.0));
    for (int i = 0; i < corners; ++i)
      ends.push_back(ends.back() + from(0.3, 1.0));
    std::vector<Vec2> result;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      add_corner(2.0 * std::numbers::pi * ends[i] / ends.back(),
                 2.0 * std::numbers::pi * ends[i + 1] / ends.back(), result);
    return result;
  }

  void add_corner(double angle, double next, std::vector<Vec2>& result) {
    const double radius = from(3.0, 10.0), kind = from(0.0, 1.0), wide = 0.3 * (next - angle);
    const auto add_point = [&](double r, double phi) {
      result.push_back(r * Vec2(std::cos(phi), std::sin(phi)));
    };
    add_point(radius, angle);
    if (kind < 0.25) { // a slit
      const double gap = std::pow(10.0, from(std::log10(narrowest_), std::log10(widest_))),
                   end = from(1.0, 2.5);
      add_point(radius, angle + wide - gap / radius);
      add_point(end, angle + wide);
      add_point(radius, angle + wide + gap / radius);
    } else if (kind < 0.5) { // a spike
      const double half = 0.5 * from(15.0, 40.0) * std::numbers::pi / 180.0;
      const double high = std::min(from(1.0, 4.0), wide * radius / std::tan(half));
      const double phi = angle + 0.5 * (next - angle), foot = high * std::tan(half) / radius;
      add_point(radius, phi - foot);
      add_point(radius + high, phi);
      add_point(radius, phi + foot);
    }
  }

  std::mt19937 random_;
  double narrowest_, widest_; ///< of slits, half [mm]
};

} // namespace billet::geometry
