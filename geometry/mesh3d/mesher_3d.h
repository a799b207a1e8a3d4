// Tetrahedra in a body that is bounded by triangles.
//
// Delaunay refinement with protected edges, then perturbation and exudation of flat tetrahedra, as
// CGAL does it. Edges sharper than the feature angle stay; elsewhere the surface is met within a
// share of the size. The same surface gives the same mesh, to the bit. Theory:
// docs/theory/geometry.md (G.38).
//
// Units   mm; angles in degrees.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh3d/solid_estimate.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// Tetrahedra with positive volume: the fourth corner lies where the first three turn
/// counter-clockwise seen from it.
struct SolidMesh {
  std::vector<Vec3> points; ///< corners [mm]
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
};

/// Tetrahedra of about `size` in a closed surface; smaller ones where it is strongly curved or
/// features lie close together. solid_estimate.h says before how many.
///
/// Shapes smaller than `details` are not followed: sharp edges that lie closer together are not
/// kept, and the surface is met within half of it. (G.58)
///
/// @param surface   closed, turned outwards, without the flaws that `complaints` finds
/// @param estimate  of this surface and this refinement
/// @throws Error(Fault::geometry) if the surface is not closed or is inside out, if nothing could
/// be
///         meshed or a tenth of the volume were missing; Error(Fault::limit) if the estimate is too
///         high (`require_meshable`), or was far too low
[[nodiscard]] SolidMesh mesh_solid(const TriangleMesh& surface,
                                   const SolidRefinement& wanted,
                                   const SolidEstimate& estimate);
[[nodiscard]] SolidMesh mesh_solid(const TriangleMesh& surface, const SolidRefinement& wanted);

/// Smallest angle between two faces of a tetrahedron [degrees].
[[nodiscard]] double smallest_dihedral(const SolidMesh& mesh);

/// Of all tetrahedra [mm^3].
[[nodiscard]] double volume(const SolidMesh& mesh);

} // namespace billet::geometry
