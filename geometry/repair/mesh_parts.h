// The parts of a triangulated surface: closed shells and open sheets, and which lies in which.
//
// A closed shell that lies in no other is outer. One inside another is a cavity if it faces its own
// inside, and without effect if it faces the material around it.
//
// Units   those of the caller (mm).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace billet::geometry {

/// Triangles that hang together by common points.
struct MeshPart {
  std::int64_t triangles = 0;
  bool closed = true;
  double volume = 0.0;          ///< [mm^3], < 0: faces its inside; 0 if open
  Box bounds;                   ///< [mm]
  Vec3 at = Vec3::Zero();       ///< a corner of its first triangle [mm]
  std::vector<std::int32_t> in; ///< the closed parts around it
};

struct MeshParts {
  std::vector<MeshPart> list;            ///< in the order of their first triangles
  std::vector<std::int32_t> of_triangle; ///< shape (n_triangles), numbers in `list`
  bool nesting_known = true;             ///< false: too many parts, every `in` is empty
};

[[nodiscard]] MeshParts parts_of(const TriangleMesh& mesh);

/// Outer shells that face their inside, with what they hold, are turned if another outer shell
/// faces outwards, or if `all`. A surface that is inside out as a whole is left: the metal may be
/// meant to lie inside.
///
/// @return number of outer shells turned; `parts` is kept up to date
std::int64_t turn_outwards(TriangleMesh& mesh, MeshParts& parts, bool all);

} // namespace billet::geometry
