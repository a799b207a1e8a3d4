// The contact surface of the workpiece in facets: segments in the plane, triangles in space.

#pragma once

#include "contact/contact_surface.h"
#include "geometry/rigid_surface.h"

#include <span>

namespace billet::process {

/// The surface of the workpiece in facets, as many of each face, one face after another.
struct DrawnWorkpiece {
  geometry::DisplayMesh mesh;
  double error = 0.0; ///< by how much the facets are off the surface [mm]
};

/// @param x  positions of the nodes, shape (n_dofs) [mm]
[[nodiscard]] DrawnWorkpiece drawn_workpiece(const contact::ContactSurface& surface,
                                             std::span<const double> x);

} // namespace billet::process
