// Quadratic simplices from what the meshers of geometry/ make.
//
// Units   those of the case (mm).

#pragma once

#include "geometry/mesh2d/mesher_2d.h"
#include "geometry/mesh3d/mesher_3d.h"
#include "geometry/mesh3d/solid_remesher.h"
#include "mechanics/mesh/mesh.h"

namespace billet::mechanics {

/// tri6; the middle nodes of the boundary stand on the outline's lines and arcs.
///
/// Node sets "segment-1", "segment-2", ...: the nodes on each segment of the outline in the order
/// of its file, a closing line last.
[[nodiscard]] Mesh triangle_mesh(const geometry::PlaneMesh& domain);

/// tet10 with straight edges; no node sets.
[[nodiscard]] Mesh tetrahedron_mesh(const geometry::SolidMesh& domain);

/// tet10; the middle nodes of the boundary are those of its edges, edges inside are straight.
[[nodiscard]] Mesh tetrahedron_mesh(const geometry::RemeshedSolid& solid);

} // namespace billet::mechanics
