// Which edges of a boundary stay when it is meshed anew, as chains between corners, and the patches
// between them. Internal to geometry/.
//
// An edge stays where the part changes, where it is sharp and where the caller says so; a short
// crease that ends nowhere does not. Chains end at corners: where other than two edges that stay
// meet, at kept points and where the chain turns by more than 45 degrees. Theory:
// docs/theory/geometry.md (G.45).
//
// Units   mm.

#pragma once

#include "geometry/curved/solid_boundary.h"
#include "geometry/triangles/corner_normals.h"

#include <array>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// An edge of the boundary that stays, in the direction of its chain.
struct LinePiece {
  std::array<std::int32_t, 2> ends; ///< points of the boundary
  std::int32_t triangle;            ///< one that it is a side of
  std::int32_t side;                ///< from that corner of the triangle to the next
};

struct FeatureLines {
  std::vector<std::vector<LinePiece>> chains;
  std::vector<std::vector<std::int32_t>> patches; ///< adjacent to each chain, sorted
  std::vector<std::int32_t> patch;                ///< of each triangle, from 0
  std::int32_t n_patches = 0;
  std::vector<std::int32_t> lone_corners; ///< kept points that are on no chain
};

/// @param short_crease  creases that end nowhere and are shorter than this are left out [mm]
/// @pre normals = corner_normals(boundary.mesh, ...)
[[nodiscard]] FeatureLines
feature_lines(const SolidBoundary& boundary, const CornerNormals& normals, double short_crease);

} // namespace billet::geometry
