// Balls that lie in a tool and mark where it is narrow. (G.60)
//
// Frame   tool frame. Units: mm. Theory: docs/theory/geometry.md (G.60).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

namespace billet::geometry {

/// A ball that lies in a tool.
struct InnerBall {
  Vec3 centre;   ///< [mm]
  double radius; ///< 0: a corner, or a place on an edge [mm]
};

/// Which balls are asked for.
struct NarrowSearch {
  Box window;   ///< large tools are looked at here [mm]
  double width; ///< what is rounder than this is not narrow [mm], > 0

  /// Between balls along an edge or a round part [mm].
  [[nodiscard]] double step() const { return 0.25 * width; }
};

} // namespace billet::geometry
