// Closing of cracks: border points and border edges that nearly coincide.
//
// Internal to geometry/: a step of mesh_repair.h. No point moves, and no edge bends, by more than
// the tolerance; interior points of the surface stay where they are.

#pragma once

#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>

namespace billet::geometry {

/// What stitching did.
struct Stitching {
  std::int64_t merged_points = 0; ///< border points moved to a neighbour across a crack
  std::int64_t t_junctions = 0;   ///< border points inserted into the border edge they lie on
  double largest_move = 0.0;      ///< of a point, or of an edge at an inserted point [mm]
};

/// Merges border points nearer than `tolerance` (and than a quarter of their border edges), then
/// inserts border points into border edges nearer than `tolerance`.
///
/// @param tolerance  [mm], > 0
Stitching stitch(TriangleMesh& mesh, double tolerance);

} // namespace billet::geometry
