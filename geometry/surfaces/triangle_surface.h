// A die given by triangles.
//
// The gap is the distance to the nearest triangle; its sign comes from the angle-weighted
// pseudo-normal of the nearest face, edge or vertex (G.14), which is right on both sides of every
// edge. Outside a convex edge or vertex, and inside a concave one, the normal points along the line
// to the closest point and so turns continuously; dnormal_dx is the derivative of that direction
// and zero over a face.
//
// A closed mesh is signed everywhere. An open one has a front (the side its triangles turn
// counter-clockwise on). A point whose closest point is on the border and which projects beyond it
// has its distance if it is in front, and is not found if it is behind; overshoot below 1e-9 of the
// size of the mesh does not count as beyond. `patch` is the number of the triangle.
//
// Queries walk a tree of boxes, nearest first, and take the smallest (distance, triangle number):
// the result has the same bits for any hint, order and thread. With the hint of a query nearby most
// points close to the surface need no walk: their triangle is proven to be the nearest. (G.34)
//
// Frame   tool frame. Units: lengths in mm.

#pragma once

#include "geometry/rigid_surface.h"
#include "geometry/triangles/triangle_mesh.h"

namespace billet::geometry {

/// Die with these triangles; builds the search trees. (G.12)-(G.14)
///
/// @throws Error(Fault::geometry) with empty place if `complaints(health(mesh))` finds any
[[nodiscard]] SurfacePtr make_triangle_surface(const TriangleMesh& mesh);

} // namespace billet::geometry
