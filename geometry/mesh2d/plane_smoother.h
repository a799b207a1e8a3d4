// Smoothing of triangles in the plane. Internal to geometry/. Theory: docs/theory/geometry.md
// (G.37).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh2d/mesher_2d.h"

namespace billet::geometry {

/// Smallest angle of a triangle [rad]; negative if it turns right.
[[nodiscard]] double smallest_angle(const Vec2& a, const Vec2& b, const Vec2& c);

/// Moves inner corners one after the other to the mean of their neighbours, where the smallest
/// angle around them grows by it; ten times over.
void smooth(PlaneMesh& mesh);

} // namespace billet::geometry
