// Delaunay refinement of a domain bounded by smooth curves. Internal to geometry/.
//
// Ruppert's and Shewchuk's algorithm, with sizes that vary and with boundary sides that are split
// on their curve. Sides see only what lies in the domain: the lips of a fold do not refine each
// other. Theory: docs/theory/geometry.md (G.43).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/mesher_2d.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace billet::geometry {

/// A side of the new boundary, as places on a curve.
struct CurveSide {
  std::int32_t loop; ///< number of the curve
  double from, to;   ///< arc lengths [mm]

  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};

/// Triangles and the boundary sides they ended up with, of which `sides` are the places.
struct RefinedDomain {
  PlaneMesh mesh;
  std::vector<CurveSide> sides;
};

/// What refinement goes by.
struct RefinementRules {
  std::function<double(const Vec2&)> size; ///< length of sides at a place [mm]
  double shortest;                         ///< boundary sides are not made shorter [mm]
};

/// @param sides  of the boundary, whose chords do not cross; in turn, loop by loop
/// @throws Error(Fault::geometry) if chords cross, Error(Fault::limit) beyond ten million triangles
[[nodiscard]] RefinedDomain refine(std::span<const BoundaryCurve> curves,
                                   const std::vector<CurveSide>& sides,
                                   const RefinementRules& rules);

} // namespace billet::geometry
