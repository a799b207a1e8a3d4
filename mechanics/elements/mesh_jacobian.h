// Jacobian of the map from the reference cell to a cell of a mesh, for judging meshes.
//
// Reference cells: quadrilaterals and hexahedra on [-1, 1], triangles and tetrahedra on [0, 1] with
// the first node at the origin. In the plane the third column is the unit vector along z, so that
// one determinant serves both dimensions.

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// d x / d xi at a place of the reference cell; columns are the tangents. [mm]
///
/// @param points  shape (nodes_per_element) [mm]
[[nodiscard]] Mat3 jacobian(ElementKind kind, std::span<const Vec3> points, const Vec3& xi);

/// Gradients of the shape functions at a place of the reference cell, shape (nodes_per_element)
/// [-].
[[nodiscard]] std::vector<Vec3> shape_gradients(ElementKind kind, const Vec3& xi);

/// A place of the reference cell and the part of its volume it stands for.
struct Sample {
  Vec3 xi;       ///< [-]
  double weight; ///< [-]
};

/// Corners of the reference cell, shape (corners_per_element).
[[nodiscard]] std::span<const Vec3> reference_corners(ElementKind kind);

/// Quadrature that measures a cell exactly, however curved.
[[nodiscard]] std::span<const Sample> measuring_points(ElementKind kind);

} // namespace billet::mechanics
