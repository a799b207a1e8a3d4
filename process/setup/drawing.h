// The workpiece and its tools in facets, as two bodies of which one comes towards the other.
//
// Contact points miss a tip of a tool that comes down between them; facets of both do not. What a
// drawing is off by its surface is known, and is what facets may cut each other by.
//
// Units: lengths in mm. Theory: docs/theory/process.md (P.4), (P.31), geometry.md (G.33).

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/base/box.h"
#include "geometry/rigid_surface.h"

#include <span>

namespace billet::process {

/// How exactly facets are compared, as a share of the size of the workpiece.
inline constexpr double facet_tolerance = 1e-6;

/// The surface of the workpiece in facets, and by how much these are off it [mm].
struct DrawnWorkpiece {
  geometry::DisplayMesh mesh;
  double error = 0.0;
};

/// @param x  positions of the nodes, shape (n_dofs) [mm]
[[nodiscard]] DrawnWorkpiece drawn(const contact::ContactSurface& surface,
                                   std::span<const double> x);

/// How far a drawing stands out of the surface it stands for, at middles of its facets [mm].
[[nodiscard]] double excess(const geometry::RigidSurface& surface,
                            const geometry::DisplayMesh& mesh);

/// Drops the triangles that the workpiece cannot meet: of a large die most.
void keep_within(const Box& window, geometry::DisplayMesh& mesh);

} // namespace billet::process
