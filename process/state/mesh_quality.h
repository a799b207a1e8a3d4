// Shape and size of the elements of a mesh.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::process {

/// Positions of nodes as points in space [mm].
///
/// @param x  shape (n_points, dim) [mm]
[[nodiscard]] std::vector<Vec3> as_points(std::span<const double> x, int dim);

/// Scaled Jacobian of the worst element.
///
/// @param x  positions of the nodes, shape (n_points, dim) [mm]
[[nodiscard]] double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x);

/// Side of an equilateral triangle, of a regular tetrahedron, of a square or of a cube of the mean
/// size of the elements [mm].
[[nodiscard]] double mean_side(const mechanics::Mesh& mesh);

} // namespace billet::process
