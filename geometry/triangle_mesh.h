// Triangles in space, as read from an STL, and what is wrong with them.
//
// Triangles turn counter-clockwise seen from outside the tool. Three clean-up steps change no shape
// beyond a stated tolerance (weld, drop, flip); everything else is reported, not mended.
//
// Units   those of the caller (mm). Theory: docs/theory/geometry.md (G.12), (G.13).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/base/vector.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
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
};

/// The state of a surface; everything but the counts of triangles and points is 0 if sound.
struct MeshHealth {
  std::int64_t points = 0;
  std::int64_t triangles = 0;
  std::int64_t degenerate_triangles = 0; ///< no area
  std::int64_t duplicate_triangles = 0;  ///< same corners as an earlier one, any orientation
  std::int64_t border_edges = 0;         ///< belong to one triangle
  std::int64_t non_manifold_edges = 0;   ///< belong to more than two triangles
  std::int64_t inconsistent_edges = 0;   ///< both triangles run through it in the same direction
  std::int64_t components = 0;           ///< parts that share no point
  double volume = 0.0;                   ///< enclosed [mm^3], < 0: inside out; 0 if not closed
  double area = 0.0;                     ///< [mm^2]
  Box bounds;                            ///< [mm]
  std::optional<Vec3> non_manifold_at;   ///< the middle of the first such edge [mm]
  std::optional<Vec3> inconsistent_at;   ///< the middle of the first such edge [mm]
  std::optional<Vec3> degenerate_at;     ///< the first corner of the first such triangle [mm]

  [[nodiscard]] bool closed() const {
    return triangles > 0 && border_edges == 0 && non_manifold_edges == 0 && inconsistent_edges == 0;
  }
  [[nodiscard]] bool inside_out() const { return closed() && volume < 0.0; }
};

/// Merges identical points, drops triangles that have lost a corner or repeat another one, and
/// swaps the diagonal between a triangle whose height is below `flatness` and its neighbour across
/// the longest edge. (G.13)
///
/// @param flatness  [mm], >= 0; 0: rounding of the coordinates only
CleanUp clean_up(TriangleMesh& mesh, double flatness);

/// Counts what `MeshHealth` lists; O(n log n).
[[nodiscard]] MeshHealth health(const TriangleMesh& mesh);

/// Why this surface cannot serve as a tool, with coordinates; empty if it can.
[[nodiscard]] std::vector<Complaint> complaints(const MeshHealth& health, const std::string& place);

/// The same triangles seen from the other side.
[[nodiscard]] TriangleMesh flipped(TriangleMesh mesh);

} // namespace billet::geometry
