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
#include "geometry/mesh_health.h"
#include "geometry/triangle_mesh.h"

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
/// features lie close together.
///
/// @param surface        closed, turned outwards, without the flaws that `complaints` finds
/// @param size           longest side on features, radius of spheres around tetrahedra [mm], > 0
/// @param feature_angle  edges whose normals differ by more are kept [degrees]
/// @throws Error(Fault::geometry) if the surface is not closed or is inside out or nothing could be
///         meshed, Error(Fault::limit) if it would take more than five million tetrahedra
[[nodiscard]] SolidMesh
mesh_solid(const TriangleMesh& surface, double size, double feature_angle = default_feature_angle);

/// Smallest angle between two faces of a tetrahedron [degrees].
[[nodiscard]] double smallest_dihedral(const SolidMesh& mesh);

/// Of all tetrahedra [mm^3].
[[nodiscard]] double volume(const SolidMesh& mesh);

} // namespace billet::geometry
