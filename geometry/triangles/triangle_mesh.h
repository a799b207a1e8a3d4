// Triangles in space, as read from an STL, and their clean-up.
//
// Triangles turn counter-clockwise seen from outside the tool. The clean-up changes no shape beyond
// the rounding of the coordinates. What is wrong with a surface is found by mesh_health.h; cracks,
// turned triangles and the like are repaired by mesh_repair.h.
//
// Units   those of the caller (mm). Theory: docs/theory/geometry.md (G.12), (G.13).

#pragma once

#include "geometry/base/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace billet::geometry {

/// Points and triangles that index them.
struct TriangleMesh {
  std::vector<Vec3> points;                           ///< [mm]
  std::vector<std::array<std::int32_t, 3>> triangles; ///< point numbers, counter-clockwise
};

/// What a clean-up did.
struct CleanUp {
  std::int64_t welded_points = 0;        ///< merged with an identical one
  std::int64_t unused_points = 0;        ///< belonged to no triangle, removed
  std::int64_t degenerate_triangles = 0; ///< two corners coincide: dropped
  std::int64_t duplicate_triangles = 0;  ///< same corners, same orientation: dropped
  std::int64_t slivers = 0;              ///< flat within the tolerance: merged with the neighbour
  std::int64_t collapsed_edges = 0;      ///< shorter than the tolerance: drawn to a point
};

/// Merges identical points, drops triangles that have lost a corner or repeat another one, swaps
/// the diagonal between a triangle whose height is below `flatness` and its neighbour across the
/// longest edge, and draws edges shorter than `flatness` to a point. (G.13)
///
/// @param flatness  [mm], >= 0; 0: rounding of the coordinates only
CleanUp clean_up(TriangleMesh& mesh, double flatness);

/// The later steps of `clean_up`, for a mesh without identical points.
void drop_useless(TriangleMesh& mesh, CleanUp& done);
void remove_slivers(TriangleMesh& mesh, double flatness, CleanUp& done);

/// The same triangles seen from the other side.
[[nodiscard]] TriangleMesh flipped(TriangleMesh mesh);

} // namespace billet::geometry
