// A turned tool: a profile of lines and arcs turned about an axis. A grooved roll, a shaped die.
//
// The profile (geometry/surfaces/profile.h) lies in the meridian half-plane: its x is the height h
// along the axis from `point`, its y the radius r. The tool lies on the LEFT of the direction of
// travel, so an open profile run against the axis (h falling) is a solid roll, one run along it a
// bore, and a closed one a ring of that section. Gap, normal and its derivative are exact (G.39).
//   Joints and rims are those of the profile: beyond the end of an open profile, and behind its
//   tangent, there is no tool.
//   An end on the axis (r = 0) is no rim: the profile goes on as its mirror image, so that a ball,
//   a pointed or a flat end closes there. Elsewhere a profile may not touch the axis.
// Where the closest point is not unique (on the axis) a fixed one is chosen, as for other shapes.
//
// Frame   tool frame. Units: lengths in mm. `axis` need not be a unit vector.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"
#include "geometry/surfaces/profile.h"

#include <string>
#include <vector>

namespace billet::geometry {

/// What is wrong with a profile that is to be turned, one sentence a flaw: those of any profile,
/// and points beyond the axis, or on it elsewhere than at the ends of an open profile.
[[nodiscard]] std::vector<std::string> turning_flaws(const Profile& profile);

/// Surface of revolution of a profile (h, r). (G.39)
///
/// @throws Error(Fault::geometry) with empty place if `turning_flaws` finds any
[[nodiscard]] SurfacePtr
make_revolved_profile(const Vec3& point, const Vec3& axis, const Profile& profile);

} // namespace billet::geometry
