// Range checks shared by the make_ functions of the analytic surfaces.
//
// Each throws Error(Fault::geometry) with empty place; the reader of the case knows the place.

#pragma once

#include "geometry/base/vector.h"

#include <string_view>

namespace billet::geometry {

/// All coordinates finite.
void require_point(const Vec3& point, std::string_view what);

/// Finite and not the zero vector.
void require_direction(const Vec3& direction, std::string_view what);

/// Strictly between the bounds; `upper` may be infinite.
void require_between(double value, double lower, double upper, std::string_view what);

} // namespace billet::geometry
