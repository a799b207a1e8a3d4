// Fields known at the integration points of one mesh, wanted at other points of the same body.
//
// The values that a field hangs on at a new point are those of the element around it and of its
// neighbours across nodes: neighbours by topology, so that nothing leaks across a fold or a thin
// gap. Every result depends on distances and on sums of values only: it turns with the frame, and
// no unit matters. Theory: docs/theory/mechanics.md (M.34)-(M.37); measured in
// docs/decisions/0011-state-transfer.md.

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// How a value reaches a new point.
enum class TransferMethod {
  nearest, ///< the value of the nearest point
  nodal,   ///< from the points to the nodes, means there, and by the shape functions to the point
  patch    ///< a quadratic least-squares fit through the points around, bounded by them
};

/// Fields at points that belong to elements, the same number to each.
struct PointField {
  const Mesh* mesh;                ///< tells which elements are neighbours
  std::span<const Vec3> positions; ///< shape (n_elements, points an element) [mm]
  std::span<const double> values;  ///< shape (n_elements, points an element, sum of `groups`)
  /// Number of components of each quantity in turn: 1 for a scalar, more for a vector or tensor,
  /// whose components must be such that the sum of their squares does not depend on the frame.
  std::span<const int> groups;
};

/// The fields at new points.
struct TransferredField {
  std::vector<double> values;    ///< shape (n, sum of groups)
  std::vector<Index> coincident; ///< the old point in the same place, shape (n); -1: none
  std::vector<char> limited;     ///< whether the bounds of (M.36) acted, shape (n)
};

/// Transfers fields to points.
///
/// @param at  places of the points in the old mesh, shape (n)
/// @pre `nodal` needs the points of the integration rule, or one an element
[[nodiscard]] TransferredField transfer_field(const PointField& from,
                                              std::span<const Vec3> points,
                                              std::span<const MeshLocation> at,
                                              TransferMethod method);

} // namespace billet::mechanics
