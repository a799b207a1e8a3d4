// The boundary of a distorted body as triangles, and places on it.
//
// Units   mm. Theory: docs/theory/geometry.md (G.45).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace billet::geometry {

/// A closed surface that faces outwards, and what hangs on it.
struct SolidBoundary {
  TriangleMesh mesh;
  std::vector<std::int32_t> part; ///< of each triangle; where it changes a line is kept
  std::vector<char> hold; ///< of each triangle: nodes stay on it (tool, symmetry); others may be
                          ///< moved along the normal to restore the volume
  std::vector<char> keep; ///< of each point: kept in any case
  std::vector<std::array<std::int32_t, 2>> lines; ///< further edges that are kept
  /// Sharp edges, where triangles stand for curved faces, the smaller point first, sorted; without
  /// them edges are sharp whose triangles turn by more than 30 degrees.
  std::optional<std::vector<std::array<std::int32_t, 2>>> creases = std::nullopt;
};

/// A place on a triangle: barycentric coordinates (1 - v - w, v, w).
struct SurfacePlace {
  std::int32_t triangle = 0;
  double v = 0.0, w = 0.0;
};

} // namespace billet::geometry
