// What meshing a part anew needs to know of it, in the plane and in space.

#pragma once

#include "contact/contact_surface.h"
#include "mechanics/mesh.h"
#include "process/part_boundary.h"

#include <functional>
#include <span>
#include <vector>

namespace billet::process {

/// The part on a new mesh, and how its contact finds what the old one knew.
struct NewPart {
  RemeshedPart part;
  /// For every contact point of the new surface those of the old one that it lies between.
  ///
  /// @param x  positions of the new nodes
  std::function<std::vector<contact::PointSource>(const contact::ContactSurface&,
                                                  std::span<const double> x)>
      sources;
};

/// Scaled Jacobian of the worst element.
///
/// @param x  positions of the nodes, shape (n_points, dim) [mm]
[[nodiscard]] double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x);

/// Side of an equilateral triangle, of a regular tetrahedron, of a square or of a cube of the mean
/// size of the elements [mm].
[[nodiscard]] double mean_side(const mechanics::Mesh& mesh);

} // namespace billet::process
