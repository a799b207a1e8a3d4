// Corners and edges of the kinds of cell, from which faces and mid-side nodes follow.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <span>

namespace billet::mechanics {

/// Number of corners of a cell: 3, 4 or 8; nodes from there on are mid-side nodes.
[[nodiscard]] int corners_per_element(ElementKind kind);

/// Number of corners of its faces: 2 (sides in the plane), 3 or 4.
[[nodiscard]] std::size_t corners_per_face(ElementKind kind);

/// True if the cell has a node in the middle of each edge.
[[nodiscard]] bool is_quadratic(ElementKind kind);

/// True of triangles and tetrahedra.
[[nodiscard]] bool is_simplex(ElementKind kind);

/// The two corners of each edge; in a quadratic cell node `corners_per_element(kind) + i` lies on
/// edge i.
[[nodiscard]] std::span<const std::array<int, 2>> element_edges(ElementKind kind);

} // namespace billet::mechanics
