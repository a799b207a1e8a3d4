// Tractions and body forces on a new mesh of the part. (P.45)

#pragma once

#include "process/remeshing/part_boundary.h"
#include "process/scene/scene.h"

#include <span>

namespace billet::process {

/// Gives the dead loads of a new mesh their nodal forces: densities are carried over from face to
/// nearest face, and the resultant stays what it was.
///
/// @param x     positions of the old nodes, shape (n_points, dim) [mm]
/// @param anew  its loads have their faces
void carry_dead_forces(const Part& old, std::span<const double> x, RemeshedPart& anew);

} // namespace billet::process
