// Checks that every rigid surface must pass, whatever its shape.
//
// The gap is a signed distance: its gradient is the normal, the normal's derivative is dnormal_dx,
// and the closest point lies on the surface.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace billet::geometry {

inline constexpr double far = 1e3; // reach that leaves nothing out in scenes of size 1 to 10

inline Projection
projection(const RigidSurface& surface, const Vec3& x, double reach = far, std::int32_t hint = -1) {
  Projection p;
  p.patch = hint;
  surface.project({&x, 1}, reach, {&p, 1});
  return p;
}

/// Points spread evenly over a box of half-width `half` about the origin, the same in every run.
inline std::vector<Vec3> random_points(std::size_t n, double half, bool planar = false) {
  std::mt19937 generator(20240611);
  std::uniform_real_distribution<double> coordinate(-half, half);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = coordinate(generator), y = coordinate(generator), z = coordinate(generator);
    points.emplace_back(x, y, planar ? 0.0 : z);
  }
  return points;
}

/// x = foot + gap normal, a unit normal, and a foot on the surface.
inline void expect_consistent(const RigidSurface& surface, const Vec3& x) {
  constexpr double rounding = 1e-12; // a few hundred units in the last place of coordinates to 10
  const Projection p = projection(surface, x);
  ASSERT_TRUE(p.found());
  EXPECT_NEAR(p.normal.norm(), 1.0, rounding);
  EXPECT_NEAR((p.foot + p.gap * p.normal - x).norm(), 0.0, rounding);
  EXPECT_NEAR(projection(surface, p.foot).gap, 0.0, rounding);
  EXPECT_TRUE(p.dnormal_dx.allFinite());
  EXPECT_NEAR((p.dnormal_dx - p.dnormal_dx.transpose()).norm(), 0.0, rounding * far);
}

/// Central differences of gap and normal. Skips a point where a neighbour falls on another patch
/// of the surface (the normal then jumps, which no derivative describes).
///
/// @return whether the point was checked
inline bool expect_derivatives(const RigidSurface& surface, const Vec3& x, bool planar = false) {
  // Truncation is h^2 times the third derivative (curvature^2 here), rounding is 1e-15 / h.
  constexpr double h = 1e-5, tolerance = 1e-7;
  const Projection p = projection(surface, x);
  EXPECT_TRUE(p.found());
  for (int i = 0; i < (planar ? 2 : 3); ++i) {
    const Projection plus = projection(surface, x + h * Vec3::Unit(i));
    const Projection minus = projection(surface, x - h * Vec3::Unit(i));
    const double jump = (plus.normal - 2.0 * p.normal + minus.normal).norm();
    const double curvature = p.dnormal_dx.norm();
    if (!plus.found() || !minus.found() || jump > 1e-3 * h + 10.0 * h * h * curvature * curvature ||
        h * curvature > 1e-4)
      return false;
    EXPECT_NEAR((plus.gap - minus.gap) / (2.0 * h), p.normal[i], tolerance * (1.0 + curvature));
    const Vec3 slope = (plus.normal - minus.normal) / (2.0 * h);
    EXPECT_NEAR((slope - p.dnormal_dx.col(i)).norm(), 0.0,
                tolerance * (1.0 + curvature + curvature * curvature * curvature * 1e-2))
        << "at " << x.transpose();
  }
  return true;
}

/// All bits of two projections agree.
inline bool same_bits(const Projection& p, const Projection& q) {
  return p.found() == q.found() && (!p.found() || p.gap == q.gap) && p.foot == q.foot &&
         p.normal == q.normal && p.dnormal_dx == q.dnormal_dx && p.patch == q.patch;
}

} // namespace billet::geometry
