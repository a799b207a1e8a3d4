// Two segments of the plane: how far apart, or how deep they cut. Internal to geometry/.
//
// Units   lengths in mm.

#pragma once

#include "geometry/base/vector.h"

namespace billet::geometry {

struct Segment {
  Vec2 from; ///< [mm]
  Vec2 to;   ///< [mm]
};

/// Smallest distance between two segments [mm]; 0 if they cut.
[[nodiscard]] double distance(const Segment& a, const Segment& b);

/// How far one would have to move for crossing segments to come apart [mm], along the normal of
/// either; 0 if they do not cross.
[[nodiscard]] double cut_depth(const Segment& a, const Segment& b);

/// Where the lines of two crossing segments meet [mm].
[[nodiscard]] Vec2 crossing(const Segment& a, const Segment& b);

} // namespace billet::geometry
