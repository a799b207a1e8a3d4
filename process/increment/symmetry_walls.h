// Planes of symmetry and the axis of revolution as walls: metal that folds onto them meets its own
// image there. (P.48)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

#include <memory>
#include <string>
#include <vector>

namespace billet::process {

/// Finds the walls of a run at its start.
void find_walls(Run& run);

/// Notes the nodes of a new mesh that may come to the walls; those on them are known.
void note_nodes_off_walls(Run& run);

/// Fails where the last attempt takes metal through a wall.
Outcome<Done> check_walls(const Run& run);

/// The step, or as much of it as passes before more metal comes to a wall.
[[nodiscard]] double up_to_walls(const Run& run, double step);

/// From now on nodes of the surface that have come to a wall stay on it, until one is pulled off.
/// @return lines for the log
std::vector<std::string> hold_on_walls(Run& run);

/// The same for all nodes that are on a wall now, however they came there.
void hold_where_on_walls(Run& run);

/// The part, with a support for the nodes on each wall after its own, so that they stay together on
/// a new mesh.
[[nodiscard]] std::shared_ptr<const Part> part_held_on_walls(const Run& run);

/// Takes those supports back from a new part; their nodes are on the walls.
void take_held_nodes(std::vector<Wall>& walls, std::vector<Support>& supports);

} // namespace billet::process
