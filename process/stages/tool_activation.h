// Tools that begin to act in the midst of a run: under a load they come to touch, on a prescribed
// way they may find the workpiece where they are.

#pragma once

#include "process/scene/scene.h"
#include "process/state/run.h"

#include <cstddef>
#include <string>

namespace billet::process {

/// Tools that begin to act by `until`, in the midst of the run: those under a force come to
/// touch, others that lie in the workpiece are noted.
void activate_tools(Run& run, const Stage& stage, double until);

/// Those that the increment that could not be solved would have met, for its post-mortem.
[[nodiscard]] std::string initial_penetrations_now(const Run& run);

} // namespace billet::process
