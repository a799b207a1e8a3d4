// How far a tool must travel until it touches: the `touch = true` of a case file.
//
// The gap is 1-Lipschitz in the position of the tool, so a tool may always travel by its smallest
// gap without touching (conservative advancement); near contact, where the gap is a fraction of a
// millionth of the size, the root is bracketed and found by secants. (G.15)
//
// Points of the workpiece miss a tip of the tool that comes down between them; facets of both do
// not.
//
// Frame   points and direction in space; lengths in mm.

#pragma once

#include "geometry/base/outcome.h"
#include "geometry/base/vector.h"
#include "geometry/collision/facet_body.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <span>

namespace billet::geometry {

/// Offset s [mm] along `direction` at which the smallest gap over `points` becomes zero.
///
/// s > 0 if the tool is clear of the points at `start`; the first contact on the way counts. s < 0
/// if it overlaps at `start`: the tool backs off until it is clear. Fails if nothing is touched
/// (or the tool is not clear) within `reach`. The gap at s is >= 0 to rounding and at most 1e-12 of
/// the size of the scene.
///
/// @param start      pose of the tool, s = 0
/// @param direction  of the tool's motion, unit vector
/// @param points     the workpiece's surface, shape (n)
/// @param reach      longest travel, and deepest overlap seen [mm], > 0
[[nodiscard]] Outcome<double> distance_to_contact(const RigidSurface& surface,
                                                  const Pose& start,
                                                  const Vec3& direction,
                                                  std::span<const Vec3> points,
                                                  double reach);

/// The same for the facets of both: where they begin to cut deeper than `tolerance` if that is
/// before `latest`, else `latest`. If they do so from the start (at 0, or where the tool has backed
/// off to), the tool backs off further. (G.33)
///
/// @param tool       at its start, s = 0
/// @param direction  of the tool's motion, unit vector
/// @param latest     offset at which the points of the workpiece are reached [mm]
/// @param tolerance  by how much the facets may be off the true surfaces [mm], > 0
[[nodiscard]] double facet_contact(const PlacedBody& tool,
                                   const Vec3& direction,
                                   const PlacedBody& workpiece,
                                   double latest,
                                   double tolerance);

} // namespace billet::geometry
