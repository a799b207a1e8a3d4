// Meshes of simple bodies: a box in the plane or in space, a cylinder.
//
// Cells are numbered by row and layer; nodes lie exactly (to the bit) on the planes of the box and
// on the cut planes of a sector, so that supports given by a plane find them. Each mesh brings the
// named node sets listed with its function.
//
// Units   those of the case (mm); angles in degrees.

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"

#include <array>
#include <span>
#include <vector>

namespace billet::mechanics {

/// A rectangle (plane kinds; the third entries are not used) or a rectangular block.
struct BoxDomain {
  ElementKind kind = ElementKind::quad8;     ///< any kind
  Vec3 low = Vec3::Zero();                   ///< smallest coordinates [mm]
  Vec3 high = Vec3::Ones();                  ///< largest coordinates [mm]
  std::array<int, 3> cells{1, 1, 1};         ///< number of cells along x, y, z
  std::array<double, 3> grading{1., 1., 1.}; ///< length of the last cell / the first, per axis [-]
};

/// A cylinder about z on the base z = 0, or the part of it with 0 <= polar angle <= sector.
struct CylinderDomain {
  ElementKind kind = ElementKind::hex20; ///< hex8, hex20 or tet10
  double radius = 1.0;                   ///< [mm]
  double height = 1.0;                   ///< [mm]
  int n_radius = 4;                      ///< cells along a radius, >= 2
  int n_height = 4;                      ///< cells along the axis
  int sector = 360;                      ///< 360, 180 (y >= 0) or 90 (x >= 0, y >= 0) [degrees]
};

/// Mesh of a box; triangles and tetrahedra by cutting each rectangle in 2, each block in 6,
/// neighbours as mirror images of each other.
///
/// Node sets "x-min", "x-max", "y-min", "y-max" and, in space, "z-min", "z-max".
/// @throws Error  for counts, lengths or gradings that are not positive, or too many cells
[[nodiscard]] Mesh box_mesh(const BoxDomain& domain);

/// Mesh of a cylinder: a square core with bulged sides and a ring around it; the mid-side nodes of
/// the outer surface lie on the true circle. Tetrahedra as in a box.
///
/// Node sets "bottom", "top", "side"; "y-min" for a half, "x-min" and "y-min" for a quarter.
/// @throws Error  for a kind, count, length or sector that is not offered
[[nodiscard]] Mesh cylinder_mesh(const CylinderDomain& domain);

/// Mesh of a quadratic kind from cells given by their corners: a node is put in the middle of each
/// edge, numbered after the corners in the order in which the cells meet the edges.
///
/// @param kind     quad8, tri6, hex20 or tet10
/// @param corners  shape (n_elements, corners per element)
[[nodiscard]] Mesh
quadratic_mesh(ElementKind kind, std::vector<Vec3> points, std::span<const Index> corners);

} // namespace billet::mechanics
