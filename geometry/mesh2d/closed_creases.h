// Places where a boundary in space cuts itself: creases whose mouth has closed.
//
// The counterpart in the plane is closed_folds.h. What lies in the crease is drawn flat, as a skin
// that spans it from rim to rim: its points stay those of the boundary, with all that hangs on
// them. Theory: docs/theory/geometry.md (G.55).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/curved/solid_boundary.h"
#include "geometry/triangles/triangle_mesh.h"

#include <optional>
#include <vector>

namespace billet::geometry {

/// A crease that was drawn flat.
struct ClosedCrease {
  Vec3 at;      ///< where its walls met [mm]
  double depth; ///< the farthest that a point of the boundary moved [mm]
};

/// Draws creases flat whose walls cut each other, until nothing of the boundary does.
///
/// Kept points stay, points of lines that stay move along them. Sharp edges within a crease are
/// sharp no more.
///
/// @param near  creases with walls no farther apart than this are closed as well [mm]; 0: walls
///              have to cut each other
/// @param rest  shortest edge that the boundary is to have: the rim lies about half of it beyond
///              what cuts at least [mm]
/// @return one for each crease; empty, with the boundary as it was: there is none, or what would
///         have to be drawn flat is more than a tenth of the surface or a hundredth of the volume
/// @pre the boundary is closed and manifold
[[nodiscard]] std::vector<ClosedCrease>
flatten_creases(SolidBoundary& boundary, double near, double rest);

/// Where triangles cut each other, all of them as one crease: half as deep as what cuts is long.
[[nodiscard]] std::optional<ClosedCrease> cut_at(const TriangleMesh& mesh);

} // namespace billet::geometry
