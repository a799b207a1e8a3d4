// Angles: radians within the code, degrees where a user states or reads them.

#pragma once

#include "geometry/base/vector.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace billet {

inline constexpr double degree = std::numbers::pi / 180.0; ///< [rad]

/// The vector along z that the plane spans by u and v: twice a triangle's area, with its sign.
[[nodiscard]] inline double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// Between two vectors of any length, well conditioned at any angle [rad].
[[nodiscard]] inline double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

} // namespace billet
