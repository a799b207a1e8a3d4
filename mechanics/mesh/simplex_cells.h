// Quadrilaterals cut into triangles, hexahedra into tetrahedra, so that neighbours match.
//
// Each cell is cut from its lowest corner: its sides that do not hold that corner are cut from
// their own lowest corner, and the pieces joined to it. What a side is cut into thus depends on the
// order of its corners only, and both cells that share it agree. Theory: docs/theory/mechanics.md
// (M.32).

#pragma once

#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// Corners of 2 triangles for each quadrilateral, of 6 tetrahedra for each hexahedron, turning as
/// the cells do.
///
/// @param dimension  2 or 3
/// @param corners    of the cells, in the order of a quad4 or hex8, shape (n, 4 or 8)
/// @param rank       of every node, shape (n_points): the lower of two corners has the lower rank,
///                   of equal ranks the lower number; empty: the number decides
/// @return           shape (2 n or 6 n, 3 or 4)
[[nodiscard]] std::vector<Index>
cut_into_simplices(int dimension, std::span<const Index> corners, std::span<const int> rank = {});

} // namespace billet::mechanics
