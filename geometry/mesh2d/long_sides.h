// How long a side may be that stands for a stretch of a boundary. Internal to geometry/.
//
// A side stands for a stretch that leaves the chord between its ends by no more than an arc would
// which turns by a given angle. A long side may do where shorter ones do not: ripples that are
// small for it need no short sides, which otherwise would stay for good where metal has left an
// edge of a tool. Theory: docs/theory/geometry.md (G.42a).
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
  /// @param stops  places that no side passes, rising
  /// @param turn   of the arc that a stretch may leave its chord as far as [rad]
  LongSides(ClosedWay way, const std::vector<double>& stops, double turn);

  /// The longest side about a place that stands for its stretch, of those tried from `most` down
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
