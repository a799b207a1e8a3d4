// How thin a body is, and how narrow the gaps next to it are. Internal to geometry/.
//
// Units   mm. Theory: docs/theory/geometry.md (G.45).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace billet::geometry {

/// A place on a surface, and the width of the wall or of the gap there.
struct WallWidth {
  std::int32_t triangle; ///< of the surface
  Vec3 at;               ///< its middle [mm]
  double width;          ///< of the wall or of the gap [mm]
  double area;           ///< of the triangle [mm^2]
  bool outside;          ///< the width of a gap
};

/// Widths below `most` of walls and gaps, by the largest balls that touch the surface at the
/// triangles' middles and again on the other side, from within and from without.
///
/// @pre the surface is closed; complaints(health(mesh)) is empty
[[nodiscard]] std::vector<WallWidth> wall_widths(const TriangleMesh& mesh, double most);

} // namespace billet::geometry
