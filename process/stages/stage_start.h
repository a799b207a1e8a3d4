// Where a stage begins: its tools, its presses, its increments.

#pragma once

#include "geometry/base/outcome.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <string>

namespace billet::process {

/// Which tools act from now on; those that touch draw back where the stage unloads.
void start_stage(Run& run, const Stage& stage);

/// Begins a stage: its tools, its presses, its increments.
Outcome<Done> begin_stage(Run& run, const Stage& stage, double start);

/// Increments as at the beginning of a stage, from a time on [s].
void begin_increments(Run& run, const Stage& stage, double start);

/// The next time at which an increment has to end, the end of the stage at the latest [s].
[[nodiscard]] double next_landing(const Run& run, double stage_end);

} // namespace billet::process
