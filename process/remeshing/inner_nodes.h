// Supports and named sets of nodes that lie inside a part, on its new mesh. (P.46)

#pragma once

#include "process/remeshing/part_boundary.h"
#include "process/scene/scene.h"

#include <span>

namespace billet::process {

/// Adds to the supports and sets of a new mesh the nodes that stand for the old ones inside the
/// part: those in the region of elements all of whose nodes belonged to it, and for each other one
/// a node near by, drawn to where it was unless that spoils an element.
///
/// @param x     positions of the old nodes, shape (n_points, dim) [mm]
/// @param anew  of simplices with middle nodes; its supports and sets have their nodes on the
///              boundary
void add_inner_nodes(const Part& old, std::span<const double> x, RemeshedPart& anew);

} // namespace billet::process
