// How good tetrahedra are, straight and with bent edges, and how they are made better. Internal to
// geometry/.
//
// Units   mm; angles in rad. Theory: docs/theory/geometry.md (G.47).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh3d/mesher_3d.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace billet::geometry {

/// Smallest angle between two faces of a straight tetrahedron; 0 or less if it is flat or turned
/// inside out [rad].
[[nodiscard]] double smallest_dihedral(const std::array<Vec3, 4>& corners);

/// How good a straight tetrahedron is: the smaller one of its smallest angle over that of a regular
/// one and of the scaled Jacobian, smallest over its corners; 1: regular, 0 or less: as above [-].
[[nodiscard]] double shape_quality(const std::array<Vec3, 4>& corners);

/// Smallest determinant of the Jacobian of a quadratic tetrahedron over its corners and middles, as
/// a multiple of that of the straight one [-]; <= 0 if the straight one is turned inside out.
///
/// @param middles  of the edges 0-1, 1-2, 2-0, 0-3, 1-3, 2-3
[[nodiscard]] double bent_jacobian(const std::array<Vec3, 4>& corners,
                                   const std::array<Vec3, 6>& middles);

/// The same of a quadratic tetrahedron by its tangents: the determinant of those of the edges that
/// leave a corner, scaled by the longer ones of tangents and chords, smallest over the corners; 1:
/// regular, 0 or less: turned inside out there [-].
///
/// @param middles  as above
[[nodiscard]] double bent_quality(const std::array<Vec3, 4>& corners,
                                  const std::array<Vec3, 6>& middles);

/// Where a node may be when it should rather be at x: the same place for a fixed one, the nearest
/// of its surface, x itself inside.
using Confine = std::function<Vec3(std::int32_t node, const Vec3& x)>;

/// Joins the nodes of tetrahedra whose `shape_quality` is below `wanted` otherwise and moves them,
/// so that the worst one gets better each time. Faces of the boundary stay.
///
/// @param movable  of each node
void improve(SolidMesh& mesh,
             const std::vector<char>& movable,
             const Confine& confine,
             double wanted);

} // namespace billet::geometry
