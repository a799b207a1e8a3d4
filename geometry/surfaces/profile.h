// The outline of a die in a plane scene: a chain of lines and circular arcs.
//
// The tool lies on the LEFT of the direction of travel, so a closed profile run counter-clockwise
// is a solid punch and one run clockwise is a container with the metal inside. The gap is the exact
// signed distance to the chain (G.8)-(G.11):
//   at a convex corner the normal of an outside point is radial from the corner;
//   inside a convex corner, and in front of a concave one, the nearer of the two segments counts;
//   behind a concave corner (in the tool) the normal is radial towards the corner;
//   a point nearest to an END of an open profile and beyond it (past the perpendicular to the end)
//   has its distance to that end if it is in front of the end's tangent, and is not found if it is
//   behind: beyond the rim there is no tool. Overshoot below 1e-9 of the profile's size does not
//   count as beyond, so that a profile may start on a symmetry axis.
// Frame   tool frame, x and y; z of a query is ignored. Units: lengths in mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace billet::geometry {

/// The way from the last point of a profile to the next.
struct ProfileSegment {
  Vec2 to = Vec2::Zero(); ///< where it ends [mm]
  double radius = 0.0;    ///< 0: line; > 0: arc turning left; < 0: arc turning right [mm]
  bool large = false;     ///< of the two arcs, the longer one (more than half a turn)
};

/// A chain of segments; a closed one gets a closing line unless it already ends at its start.
struct Profile {
  Vec2 start = Vec2::Zero(); ///< [mm]
  std::vector<ProfileSegment> segments;
  bool closed = false;
};

/// Straight segments through `points`. shape (n >= 2)
[[nodiscard]] Profile polygon(std::span<const Vec2> points, bool closed);

/// The same chain run the other way: its tool lies on the other side.
[[nodiscard]] Profile reversed(const Profile& profile);

/// What is wrong with a segment that starts at `from`: not finite, no length, radius too small for
/// its chord; none if it is sound.
[[nodiscard]] std::optional<std::string> flaw(const Vec2& from, const ProfileSegment& segment);

/// What is wrong with the chain as a whole, one sentence a flaw: no segment, folded back on itself,
/// crossing itself, open but ending where it started.
[[nodiscard]] std::vector<std::string> flaws(const Profile& profile);

/// Points along the profile, arcs in chords of at most `max_angle` [rad]; the first point of a
/// closed profile is not repeated.
[[nodiscard]] std::vector<Vec2> polyline(const Profile& profile, double max_angle);

/// Die with that outline.
///
/// @throws Error(Fault::geometry) with empty place if `flaws` finds any
[[nodiscard]] SurfacePtr make_profile(const Profile& profile);

} // namespace billet::geometry
