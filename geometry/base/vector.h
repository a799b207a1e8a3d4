// Small vectors and matrices of points, normals and tensors.
//
// Geometry and contact always work in three dimensions: a scene in the plane (or a meridian plane,
// x = radius, y = axis) has z = 0. Units are those of the case (mm by default).

#pragma once

#include <Eigen/Core>

namespace billet {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;

/// A point or vector of the plane as one of space, z = 0.
[[nodiscard]] inline Vec3 in_space(const Vec2& x) { return {x.x(), x.y(), 0.0}; }

} // namespace billet
