// Area or volume that quadratic sides enclose, and how a new boundary is given that of the old one.
// Internal to geometry/. Theory: docs/theory/geometry.md (G.44).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/domain_refinement.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "geometry/mesh2d/mesher_2d.h"

#include <span>

namespace billet::geometry {

/// What is measured, from where: near the domain for the sake of rounding, on the axis if revolved.
struct Enclosure {
  Measure measure;
  Vec2 origin; ///< [mm]
};

/// Exact for the parabolas. (G.44)
[[nodiscard]] double enclosed(const SideLoop& loop, const Enclosure& of);
[[nodiscard]] double enclosed(const PlaneMesh& mesh, const Enclosure& of);

/// Shifts the free nodes of the boundary along their normals until the measure is `wanted`; does
/// nothing if there is none. (G.44)
void restore_measure(RefinedDomain& domain,
                     std::span<const BoundaryCurve> curves,
                     const Enclosure& of,
                     double wanted);

} // namespace billet::geometry
