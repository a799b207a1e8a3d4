// Nodes that a `where` leaves out although whoever wrote it hardly meant to.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace billet::io {

/// Nodes that lie so little off a plane, next to nodes on it, that they seem meant to lie on it: a
/// mesh that was written with few digits. In words; none: there are none.
///
/// @param surface   all faces of the mesh that have an element on one side alone
/// @param on_plane  of each node of the mesh: whether it is meant
/// @param axis      of the plane's normal
/// @param value     coordinate of the plane [mm]
/// @param size      of the mesh [mm]
[[nodiscard]] std::optional<std::string>
nodes_near_plane(const mechanics::Mesh& mesh,
                 const std::vector<mechanics::Face>& surface,
                 const std::vector<char>& on_plane,
                 int axis,
                 double value,
                 double size);

/// Sides of quadratic elements whose corners are meant and none of whose middle nodes is. In words;
/// none: there are none.
///
/// @param surface  all faces of the mesh that have an element on one side alone
[[nodiscard]] std::optional<std::string>
missed_middle_nodes(const mechanics::Mesh& mesh,
                    const std::vector<mechanics::Face>& surface,
                    const std::vector<char>& meant);

} // namespace billet::io
