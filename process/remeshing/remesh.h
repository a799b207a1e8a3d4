// The part meshed anew in the midst of a run. (P.14)-(P.21)

#pragma once

#include "geometry/base/outcome.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "process/reports/observer.h"
#include "process/state/run.h"

#include <string>
#include <vector>

namespace billet::process {

/// Meshes the part anew and carries everything over. Fails where the part cannot be meshed; then
/// nothing has changed.
///
/// @param at  additional sizes, where a tool is about to touch
Outcome<Done> remesh(Run& run,
                     const std::string& cause,
                     const std::vector<Observer*>& observers,
                     const std::vector<geometry::SizeAt>& at = {});

} // namespace billet::process
