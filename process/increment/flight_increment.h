// How the run loop goes through a flight. (P.31)

#pragma once

#include "process/reports/observer.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// Whether the run is in a flight, or one begins now. (P.31)
///
/// @param length  of the stage, since the last flight [s]
[[nodiscard]] bool flies(Run& run, const Stage& stage, double length);

/// An increment of the flight, to its end or as far as it may go at once.
/// @return whether it has come to its end
bool fly(Run& run, const Stage& stage, const std::vector<Observer*>& observers);

} // namespace billet::process
