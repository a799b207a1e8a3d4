// Where the triangles of a surface cut each other, and whether that leaves its sides clear.
//
// Closed parts that face outwards may overlap or touch: seen from outside they are one body. Within
// a part, and with an open or inverted one, a cut makes inside and outside ambiguous. Cuts
// shallower than the tolerance are touches; two triangles back to back are a cut however close they
// lie. Whether two triangles meet is decided in exact arithmetic.
//
// Units   those of the caller (mm). Guide: docs/guide/stl-tools.md.

#pragma once

#include "geometry/base/error.h"
#include "geometry/base/vector.h"
#include "geometry/repair/mesh_parts.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace billet::geometry {

/// Pairs of triangles that have more in common than shared corners and edges.
struct SelfIntersections {
  std::int64_t cuts = 0;          ///< which leave it open what is inside
  std::int64_t overlaps = 0;      ///< between closed parts that face outwards: harmless
  std::int64_t touches = 0;       ///< not deeper than the tolerance: harmless
  std::optional<Vec3> cut_at;     ///< near the first one [mm]
  std::optional<Vec3> overlap_at; ///< near the first one [mm]
  bool complete = true;           ///< false: given up after too many pairs of near triangles
};

/// @param parts      of this mesh
/// @param tolerance  depth below which a cut is a touch [mm], >= 0
[[nodiscard]] SelfIntersections
self_intersections(const TriangleMesh& mesh, const MeshParts& parts, double tolerance);

/// The pairs that cut each other or lie back to back, however little and of whatever parts, sorted.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> cutting_pairs(const TriangleMesh& mesh);

/// Why this surface cannot serve as a tool; empty if nothing cuts.
[[nodiscard]] std::vector<Complaint> complaints(const SelfIntersections& found,
                                                const std::string& place);

} // namespace billet::geometry
