// Sides, height and area of single triangles; internal to geometry/.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace billet::geometry {

[[nodiscard]] inline const Vec3&
corner(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(t[i])];
}

/// Normal of twice the length of the area [mm^2].
[[nodiscard]] Vec3 doubled_area(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t);

struct TriangleShape {
  std::size_t longest_side; ///< 0, 1, 2: from that corner to the next
  double longest;           ///< length of that side [mm]
  double shortest;          ///< length of the shortest side [mm]
  double height;            ///< above the longest side, the smallest of the three [mm]
};

[[nodiscard]] TriangleShape shape_of(const TriangleMesh& mesh,
                                     const std::array<std::int32_t, 3>& t);

/// Coordinates are known no better than this [mm].
[[nodiscard]] double coordinate_rounding(const TriangleMesh& mesh);

} // namespace billet::geometry
