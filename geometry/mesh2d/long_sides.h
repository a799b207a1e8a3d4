// How long an edge may be that represents a stretch of a boundary. Internal to geometry/.
//
// An edge represents a stretch that deviates from the chord between its ends by no more than an arc
// that turns by a given angle. A long edge may do so where shorter ones do not: ripples that are
// small compared with it need no short edges, which would otherwise stay for good where metal has
// left an edge of a tool. Theory: docs/theory/geometry.md (G.42a).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"

#include <vector>

namespace billet::geometry {

/// A closed way as points along it.
struct ClosedWay {
  std::vector<Vec2> points;
  std::vector<double> places; ///< of the points along the way, rising from 0 [mm]
  double length;              ///< of the way [mm]
};

class LongSides {
public:
  /// @param stops  places that no edge passes, rising
  /// @param turn   of the arc that limits how far a stretch may deviate from its chord [rad]
  LongSides(ClosedWay way, const std::vector<double>& stops, double turn);

  /// The longest edge about a place that represents its stretch, of those tried from `most` down
  /// to `least`, or 0. [mm]
  [[nodiscard]] double longest(double place, double least, double most) const;

private:
  [[nodiscard]] bool stands(double place, double length) const;
  [[nodiscard]] Vec2 point(double place) const;

  ClosedWay way_; ///< three times around: from -length to 2 length
  std::vector<double> stops_;
  double turn_;
};

} // namespace billet::geometry
