// Random bodies with notches, thin webs, sharp corners and folds.

#pragma once

#include "geometry/curved/solid_boundary.h"
#include "tests/support/random_outline.h"
#include "tests/support/sound_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <vector>

namespace billet::geometry {

/// A plate over a random outline, thinner in a web, then twisted and bent, in some until it touches
/// itself. Its boundary has well-shaped triangles, as that of a mesh that was distorted.
class RandomSolid {
public:
  explicit RandomSolid(unsigned seed)
      : outline_(seed, seed % 5 == 0 ? 1e-6 : 0.15, 1.0), random_(seed) {}

  /// @throws Error(Fault::geometry) if the outline touches itself
  SolidBoundary boundary() {
    const SideLoop loop = outline_.loop();
    const double size = from(0.7, 1.5);
    const PlaneMesh base = remesh_domain({&loop, 1}, {0.25 * size, size}, Measure::area).mesh;
    draw_shape();
    return deformed(plate(base, size));
  }

private:
  double from(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void draw_shape() {
    height_ = from(1.0, 5.0);
    web_ = std::pow(10.0, from(-1.0, 0.0));
    middle_ = Vec2(from(-5.0, 5.0), from(-5.0, 5.0));
    radius_ = from(2.0, 6.0);
    twist_ = from(0.0, 1.0) < 0.5 ? 0.0 : from(-0.15, 0.15);
    bend_ = from(0.0, 1.0) < 0.5 ? 0.0 : from(0.02, 0.12);
  }

  [[nodiscard]] double thickness(const Vec2& x) const {
    const double t = std::clamp((x - middle_).norm() / radius_ - 0.5, 0.0, 1.0);
    return height_ * (web_ + (1.0 - web_) * t * t * (3.0 - 2.0 * t));
  }

  [[nodiscard]] SolidBoundary plate(const PlaneMesh& base, double size) const {
    TriangleMesh mesh;
    SolidBoundary result;
    const auto layers = static_cast<std::int32_t>(std::ceil(height_ / size));
    std::map<std::array<std::int32_t, 2>, std::int32_t> number;
    const auto point = [&](std::int32_t node, std::int32_t layer) {
      const auto [place, added] =
          number.try_emplace({node, layer}, static_cast<std::int32_t>(mesh.points.size()));
      if (added) {
        const Vec2& x = base.points[static_cast<std::size_t>(node)];
        mesh.points.emplace_back(x.x(), x.y(), (0.5 * layer / layers - 0.25) * 2.0 * thickness(x));
      }
      return place->second;
    };
    const auto add = [&](const std::array<std::int32_t, 3>& triangle, std::int32_t part) {
      mesh.triangles.push_back(triangle);
      result.part.push_back(part);
    };
    for (const auto& [a, b, c] : base.triangles) {
      add({point(a, 0), point(c, 0), point(b, 0)}, 0);
      add({point(a, layers), point(b, layers), point(c, layers)}, 1);
    }
    for (const BoundarySide& side : base.boundary)
      for (std::int32_t k = 0; k < layers; ++k) {
        const auto& [a, b] = side.corners;
        add({point(a, k), point(b, k), point(b, k + 1)}, 2);
        add({point(a, k), point(b, k + 1), point(a, k + 1)}, 2);
      }
    result.hold.assign(mesh.triangles.size(), 0);
    result.keep.assign(mesh.points.size(), 0);
    result.mesh = std::move(mesh);
    return result;
  }

  /// Twisted about x, then bent about y.
  [[nodiscard]] SolidBoundary deformed(SolidBoundary body) const {
    for (Vec3& x : body.mesh.points) {
      const double c = std::cos(twist_ * x.x()), s = std::sin(twist_ * x.x());
      x = Vec3(x.x(), c * x.y() - s * x.z(), s * x.y() + c * x.z());
      if (bend_ > 0.0) {
        const double r = 1.0 / bend_ + x.z(), phi = bend_ * x.x();
        x = Vec3(r * std::sin(phi), x.y(), r * std::cos(phi));
      }
    }
    return body;
  }

  RandomOutline outline_;
  std::mt19937 random_;
  double height_ = 1.0; ///< of the plate outside of its web
  double web_ = 1.0;    ///< its thickness over that of the plate
  Vec2 middle_ = Vec2::Zero();
  double radius_ = 1.0;
  double twist_ = 0.0; ///< [rad/mm]
  double bend_ = 0.0;  ///< curvature [1/mm]
};

} // namespace billet::geometry
