// Rigid tools whose shape is a formula: plane, circle, cylinder, sphere, cone, torus.
//
// Gap, normal and its derivative are exact (docs/theory/geometry.md). Every shape but the plane
// takes `inside`: false, the metal is outside the solid; true, the metal is inside a cavity of that
// shape, so that gap and normal change sign. Where the closest point is not unique (on an axis, at
// a centre) one unit normal is chosen, always the same and in the plane z = 0 if the shape's axis
// lies in it or along z; the curvature that is infinite there is given as zero.
//
// Frame   tool frame. Units: lengths in mm, angles in rad. Directions need not be unit vectors.
// Errors  a radius, angle or direction out of range throws Error(Fault::geometry) with empty place.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"

namespace billet::geometry {

/// Half-space: the tool fills the side away from `normal`. (G.2)
[[nodiscard]] SurfacePtr make_plane(const Vec3& point, const Vec3& normal);

/// Circle of a scene in the plane; z is ignored. (G.4)
[[nodiscard]] SurfacePtr make_circle(const Vec3& centre, double radius, bool inside);

/// Endless round bar (or bore) along the line through `point`. (G.4)
[[nodiscard]] SurfacePtr
make_cylinder(const Vec3& point, const Vec3& axis, double radius, bool inside);

/// Ball (or spherical hollow). (G.5)
[[nodiscard]] SurfacePtr make_sphere(const Vec3& centre, double radius, bool inside);

/// Endless cone, one nappe; `axis` points from the apex into the solid. (G.6)
///
/// @param half_angle  between axis and generator [rad], 0 < half_angle < pi/2
[[nodiscard]] SurfacePtr
make_cone(const Vec3& apex, const Vec3& axis, double half_angle, bool inside);

/// Ring of circular section. (G.7)
///
/// @param major  radius of the circle of centres [mm], > minor
/// @param minor  radius of the section [mm], > 0
[[nodiscard]] SurfacePtr
make_torus(const Vec3& centre, const Vec3& axis, double major, double minor, bool inside);

} // namespace billet::geometry
