// New sides along the curves of a boundary. Internal to geometry/.
//
// Theory: docs/theory/geometry.md (G.42). Units   mm.

#pragma once

#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/domain_refinement.h"

#include <functional>
#include <span>
#include <vector>

namespace billet::geometry {

/// Sides between the kept corners, of equal length in terms of the size: no longer than it, but for
/// the tips of wedges, which become one triangle as wide as `min`. (G.42)
///
/// @param min  smallest size [mm]
[[nodiscard]] std::vector<CurveSide> spread_sides(std::span<const BoundaryCurve> curves,
                                                  const std::function<double(const Vec2&)>& size,
                                                  double min);

/// Halves sides until the triangles that hold their parabolas meet at common corners only; so no
/// chord crosses another, however they are split afterwards.
///
/// @throws Error(Fault::geometry), with the place, if sides of `shortest` are not enough [mm]
void separate(std::span<const BoundaryCurve> curves,
              std::vector<CurveSide>& sides,
              double shortest);

/// Halves the sides whose flag is set.
[[nodiscard]] std::vector<CurveSide> halved(const std::vector<CurveSide>& sides,
                                            const std::vector<char>& flags);

} // namespace billet::geometry
