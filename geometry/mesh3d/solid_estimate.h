// How many tetrahedra a body will take, and which of its shapes ask for most of them: known before
// it is meshed, for a small detail of a large part can ask for more than anyone has time for.
//
// Units   mm. Theory: docs/theory/geometry.md (G.57).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/triangle_mesh.h"

#include <string>

namespace billet::geometry {

/// What the tetrahedra should be like.
struct SolidRefinement {
  double size; ///< longest side on features, radius of spheres around tetrahedra [mm], > 0
  double feature_angle = default_feature_angle; ///< edges whose normals differ by more are kept
                                                ///< [degrees]
  double details = 0.0; ///< shapes smaller than this are not followed [mm]; 0: all are

  /// How far facets may lie off the surface [mm].
  [[nodiscard]] double distance() const;
};

/// A kind of shape that asks for tetrahedra smaller than the size, and how many.
struct SmallShapes {
  double tetrahedra = 0.0; ///< about so many [-]
  double width = 0.0;      ///< of the narrowest one [mm]
  Vec3 at = Vec3::Zero();  ///< the middle of it [mm]
};

struct SolidEstimate {
  double bulk = 0.0;  ///< tetrahedra of the size asked for in the volume [-]
  double skin = 0.0;  ///< further ones along its surface [-]
  SmallShapes edges;  ///< sharp edges that lie close together; the width is their distance
  SmallShapes walls;  ///< thin walls; the width is their thickness
  SmallShapes curves; ///< roundings; the width is their radius

  [[nodiscard]] double tetrahedra() const {
    return bulk + skin + edges.tetrahedra + walls.tetrahedra + curves.tetrahedra;
  }
};

/// What `mesh_solid` will make of the body, to a factor of two or so. (G.57)
///
/// @pre the surface is closed and faces outwards; complaints(health(surface)) is empty
[[nodiscard]] SolidEstimate solid_estimate(const TriangleMesh& surface,
                                           const SolidRefinement& wanted);

/// Why there are more than the size alone asks for, e.g. "most of them because of edges 0.02 apart,
/// the closest at (1, 2, 3)"; empty if there is nothing to be said.
[[nodiscard]] std::string reason(const SolidEstimate& estimate);

/// Tetrahedra that may be made: ten times those that the volume and the surface take, plus two
/// hundred thousand.
[[nodiscard]] double most_tetrahedra(const SolidEstimate& estimate);

/// @throws Error(Fault::limit), with the reason, if it would take more than `most_tetrahedra`
void require_meshable(const SolidEstimate& estimate, const SolidRefinement& wanted);

} // namespace billet::geometry
