// The point of a triangle that is nearest to another point.

#pragma once

#include "geometry/base/vector.h"

#include <array>

namespace billet::geometry {

/// Barycentric coordinates of the point of a triangle nearest to x; 0 to the bit on its sides.
[[nodiscard]] std::array<double, 3>
nearest_in_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x);

} // namespace billet::geometry
