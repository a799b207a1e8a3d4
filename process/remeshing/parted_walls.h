// Where the nodes of walls that touch each other are taken to be while a new mesh is made.
//
// Walls that touch lie in each other by what their penalty needs, and a new outline follows each of
// them a little differently: they would cross. So both are drawn back by half of a small gap, which
// the volume of the part is given back afterwards.

#pragma once

#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// Committed positions of the nodes, those of faces that touch another face of the part, or nearly,
/// drawn back.
///
/// @param gap  that is left between walls that touch, at least; nearer ones are drawn back [mm]
/// @return shape (n_nodal) [mm]
[[nodiscard]] std::vector<double> positions_with_parted_walls(const Run& run, double gap);

/// Whether the part touches itself.
[[nodiscard]] bool touches_itself(const Run& run);

} // namespace billet::process
