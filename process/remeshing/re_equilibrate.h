// Equilibrium on a new mesh, before time goes on. (P.17), (P.19)

#pragma once

#include "process/remeshing/mapped_states.h"
#include "process/state/run.h"

#include <span>

namespace billet::process {

/// Solves again what led to the present state, from where the new mesh may begin, or for the
/// present state alone.
///
/// @param forces  on the tools before the mesh was new [N]
void re_equilibrate(Run& run,
                    const MappedStates& mapped,
                    std::span<const double> forces,
                    RemeshReport& report);

} // namespace billet::process
