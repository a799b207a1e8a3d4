// A die given by triangles that stand for a smooth shape.
//
// Where neighbouring triangles turn by no more than the feature angle they are replaced by curved
// ones through the same corners that share their tangent planes, so that the normal is continuous;
// sharper edges stay sharp (and become curves themselves if the sides next to them are curved).
// Flat parts stay flat and answer as those of `make_triangle_surface` do. The gap is the distance
// to that surface, so the normal is exactly its gradient and dnormal_dx the second derivative.
//
// A triangle that cannot be curved without folding stays as it is. Sides, borders, `patch`, ties
// and bits are as for `make_triangle_surface`.
//
// Frame   tool frame. Units: lengths in mm, angles in rad. Theory: docs/theory/geometry.md
// (G.16)-(G.23).

#pragma once

#include "geometry/rigid_surface.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>

namespace billet::geometry {

/// What smoothing did, for the log.
struct Smoothing {
  std::int64_t curved = 0;      ///< triangles replaced by curved ones
  std::int64_t flat = 0;        ///< triangles that lie in a plane of the shape
  std::int64_t kept = 0;        ///< triangles that could not be curved and stay as they are
  double chord_error = 0.0;     ///< largest distance between facets and curved triangles [mm]
  double remaining_error = 0.0; ///< estimate of it after smoothing [mm] (G.23)
};

struct SmoothSurface {
  SurfacePtr surface;
  Smoothing smoothing;
};

/// Die with these triangles, smoothed where they turn by no more than `feature_angle`.
///
/// @param feature_angle  [rad], 0 <= feature_angle <= pi
/// @throws Error(Fault::geometry) with empty place if `complaints(health(mesh))` finds any
[[nodiscard]] SmoothSurface make_smooth_triangle_surface(const TriangleMesh& mesh,
                                                         double feature_angle);

/// An estimate of `Smoothing::chord_error` without smoothing, from the normals at the corners of
/// the triangles [mm]. (G.35)
///
/// @param feature_angle  [rad], 0 <= feature_angle <= pi
/// @pre complaints(health(mesh)) is empty
[[nodiscard]] double chord_error(const TriangleMesh& mesh, double feature_angle);

} // namespace billet::geometry
