// One line or arc of a profile, ready for distances; internal to geometry/.
//
// The tool is on the left of the way from `a` to `b`, so the normal is the tangent turned by -90
// degrees. An arc turns left (radius > 0, centre in the tool) or right (radius < 0). Docs: (G.8).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/surfaces/profile.h"

#include <numbers>
#include <vector>

namespace billet::geometry {

/// Where on a piece its closest point to a query lies.
enum class Place { interior, start, end };

/// Squared distance to a piece, and where.
struct ClosestOnPiece {
  double distance2; ///< [mm^2]
  Place place;
};

struct ProfilePiece {
  Vec2 a = Vec2::Zero();         ///< start [mm]
  Vec2 b = Vec2::Zero();         ///< end [mm]
  Vec2 tangent_a = Vec2::Zero(); ///< unit direction of travel at the start
  Vec2 tangent_b = Vec2::Zero(); ///< and at the end
  Vec2 centre = Vec2::Zero();    ///< of an arc [mm]
  double radius = 0.0;           ///< signed; 0: line [mm]
  double sweep = 0.0;            ///< angle turned through, >= 0 [rad]

  [[nodiscard]] bool is_arc() const { return radius != 0.0; }
  [[nodiscard]] double length() const;
  /// Point at the fraction s of the length, 0 <= s <= 1.
  [[nodiscard]] Vec2 point(double s) const;
  /// Whether the direction `v` from the centre of an arc lies between its ends.
  [[nodiscard]] bool sweeps(const Vec2& v) const;
  [[nodiscard]] ClosestOnPiece closest(const Vec2& x) const;
  /// Box of the piece.
  [[nodiscard]] Box bounds() const;
};

inline constexpr double drawn_angle = 2.0 * std::numbers::pi / 64.0; ///< of a chord of a drawn arc

/// The unit vector right of the way: out of the tool.
[[nodiscard]] inline Vec2 normal_of(const Vec2& tangent) { return {tangent.y(), -tangent.x()}; }

/// The piece from `from` along `segment`, which has no `flaw`.
[[nodiscard]] ProfilePiece make_piece(const Vec2& from, const ProfileSegment& segment);

/// All pieces, the closing line included; neighbours share their end points to the bit.
[[nodiscard]] std::vector<ProfilePiece> pieces(const Profile& profile);

/// Largest extent of the profile's points [mm].
[[nodiscard]] double size(const Profile& profile);

} // namespace billet::geometry
