// Where the run was: states that a new mesh may go on from. (P.19), (P.20)

#pragma once

#include "process/state/run.h"
#include "process/state/state.h"

#include <vector>

namespace billet::process {

/// Magnitudes of the forces on all tools; empty: there is no contact. [N]
[[nodiscard]] std::vector<double> forces_on_tools(const Run& run);

/// Keeps the forces on all tools before an increment.
void note_forces(Run& run);

/// Where the run is now.
[[nodiscard]] Snapshot snapshot(const Run& run);

/// Keeps where the run is now, if the metal has flowed far enough since the last time. (P.20)
void take_snapshot(Run& run);

} // namespace billet::process
