// Whether a point of the workpiece goes through a tool within an increment.
//
// A gap looks at one instant: a point that was in front of a thin die and is behind it afterwards
// has a positive gap before and after, and one that is in the die, but nearer to its back, is
// pushed out there. So the way between is walked: both the point and the tool move at constant
// speed from where they were to where they are, turns included. The gap is 1-Lipschitz, and the way
// relative to the tool has a bound, so parts that are clear are walked in single steps.
//
// Units   mm, rad. Theory: docs/theory/geometry.md (G.31), (G.32).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <optional>

namespace billet::geometry {

/// Where a tool is on its way: arguments of Motion::pose_at.
struct Whereabouts {
  Vec3 shift = Vec3::Zero(); ///< [mm]
  double angle = 0.0;        ///< [rad]
};

/// What a point of the workpiece and a tool do during an increment.
struct Encounter {
  const Motion& motion; ///< of the tool
  Whereabouts tool_old;
  Whereabouts tool_new;
  Vec3 point_old; ///< in space [mm]
  Vec3 point_new; ///< in space [mm]
};

/// Bound of the length of the point's way relative to the tool [mm]. (G.31)
[[nodiscard]] double way(const Encounter& encounter);

/// Where in space [mm] the point has come through the tool, or past its middle; none if it has not.
/// (G.32)
///
/// @param slack  a point that is in the tool from the start may go that much deeper without being
///               followed: on the middle plane of a wedge both sides are equally near [mm], >= 0
[[nodiscard]] std::optional<Vec3>
passage(const RigidSurface& surface, const Encounter& encounter, double slack);

} // namespace billet::geometry
