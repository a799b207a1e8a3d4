// Edges that are contracted where the tetrahedra around them are poor. Internal to geometry/.
//
// Theory: docs/theory/geometry.md (G.53).

#pragma once

#include "geometry/mesh3d/patch_mesher.h"

#include <vector>

namespace billet::geometry {

/// Joins nodes of tetrahedra whose `shape_quality` is below `wanted` otherwise, and moves nodes
/// inside, within a patch of the boundary or along a line onto a neighbour, where the worst
/// tetrahedron gets better by it. Ends and turns of lines stay; so do sizes, on the whole.
///
/// @param corners  places of further nodes that stay
/// @param size     length of the edges asked for at a place [mm]
void tidy(PatchedSolid& solid,
          const std::vector<Vec3>& corners,
          const SpaceSize& size,
          double wanted);

} // namespace billet::geometry
