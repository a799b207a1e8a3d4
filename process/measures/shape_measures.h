// Figures of the part's shape: those of friction tests, and how far a die is filled.
//
// They are taken from the surface, curved faces as they are curved, not from contact points: a
// barrelled side that rolls onto the die enlarges the contact by parts of a face.

#pragma once

#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// All measures of the scene as the run is now, in their order.
[[nodiscard]] std::vector<double> measured(const Run& run);

} // namespace billet::process
