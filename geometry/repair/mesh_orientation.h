// Which way triangles face, and which of them hang together.
//
// Internal to geometry/: two steps of mesh_repair.h that change the order of corners and the
// numbers of points, never a shape.

#pragma once

#include "geometry/triangles/triangle_mesh.h"

#include <cstdint>

namespace billet::geometry {

/// Turns triangles so that neighbours face the same way: within what hangs together by edges of two
/// triangles, the smaller area follows the larger. An open sheet whose triangles disagree by more
/// than a third of its area has no front side and is left as it is.
///
/// @return number of triangles turned
std::int64_t orient(TriangleMesh& mesh);

/// Gives every fan of triangles around a vertex a point of its own. At an edge of four triangles
/// and more, each pair with material between them goes together; where the triangles do not bound
/// material in turn, the edge is left.
///
/// @return number of points added
std::int64_t split_fans(TriangleMesh& mesh);

} // namespace billet::geometry
