// Triangles in a domain of the plane that is bounded by lines and arcs.
//
// Delaunay refinement (Ruppert, Shewchuk) as CGAL does it, then smoothing where it helps.
// Corners on an arc lie on it, and the middle of each boundary side is given on its arc as well, so
// that quadratic elements follow the true outline. The same outline gives the same mesh, to the
// bit. Theory: docs/theory/geometry.md (G.37).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/surfaces/profile.h"

#include <array>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// A side of a triangle on the boundary.
struct BoundarySide {
  std::array<std::int32_t, 2> corners; ///< the domain lies on the left of the way between them
  Vec2 middle;                         ///< on the line or arc [mm]
  std::int32_t segment;                ///< number of the outline's segment, closing line included
};

/// Triangles, counter-clockwise, and the sides that make up the boundary.
struct PlaneMesh {
  std::vector<Vec2> points; ///< corners [mm]
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<BoundarySide> boundary; ///< in turn around the domain
};

/// Triangles with sides of about `size` and angles of 20 degrees and more, but where the outline
/// itself has a smaller one. Short segments and small arcs are met by smaller triangles.
///
/// @param outline  closed; turning either way
/// @param size     longest side [mm], > 0
/// @throws Error(Fault::geometry) if the outline is open or has a flaw, Error(Fault::limit) if it
///         would take more than ten million triangles
[[nodiscard]] PlaneMesh mesh_outline(const Profile& outline, double size);

/// Smallest angle of the straight-sided triangles [degrees].
[[nodiscard]] double smallest_angle(const PlaneMesh& mesh);

} // namespace billet::geometry
