// Where in a mesh is a point? The element around it and the natural coordinates there, with which
// nodal fields are interpolated.
//
// A point outside the mesh gets the nearest place of it: a remeshed boundary never quite agrees
// with the old one. Boxes in a tree name the candidates; in each the distance is minimised over the
// reference cell. Where elements tie (a point on a face that two share) the lowest number wins.
//
// Units   lengths in mm. Theory: docs/theory/mechanics.md (M.33).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/box_tree.h"
#include "mechanics/mesh/mesh.h"

#include <limits>
#include <span>
#include <vector>

namespace billet::mechanics {

/// A place in a mesh.
struct MeshLocation {
  Index element = 0;      ///< the element around the point, or the nearest one
  Vec3 xi = Vec3::Zero(); ///< natural coordinates, within the reference cell (1e-9) [-]
  double distance = 0.0;  ///< of the point from that place; rounding for a point inside [mm]
};

/// Finds places in a mesh at given positions of its nodes.
class MeshLocator {
public:
  /// @param x  positions of the nodes, shape (n_points, dim) [mm]
  /// @pre mesh and x outlive the locator; the mesh has an element
  MeshLocator(const Mesh& mesh, std::span<const double> x);

  /// @param reach  places that are farther away are not looked for [mm]
  /// @return the element -1 and an infinite distance where there is none
  [[nodiscard]] MeshLocation locate(const Vec3& point,
                                    double reach = std::numeric_limits<double>::infinity()) const;
  /// Places of many points, by several threads. [mm]
  [[nodiscard]] std::vector<MeshLocation>
  locate(std::span<const Vec3> points,
         double reach = std::numeric_limits<double>::infinity()) const;

private:
  const Mesh* mesh_;
  std::span<const double> x_;
  std::vector<double> sizes_; ///< diagonals of the elements' boxes [mm]
  geometry::BoxTree tree_;
};

/// A nodal field at a place of a mesh.
///
/// @param nodal  shape (n_points, out.size())
void interpolate(const Mesh& mesh,
                 const MeshLocation& at,
                 std::span<const double> nodal,
                 std::span<double> out);

/// Positions of the integration points, shape (n_elements, points an element) [mm].
///
/// @param x  positions of the nodes, shape (n_points, dim) [mm]
[[nodiscard]] std::vector<Vec3> integration_points(const Mesh& mesh, std::span<const double> x);

} // namespace billet::mechanics
