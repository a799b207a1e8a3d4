// A run stored and resumed: its state, the part on its present mesh, and what is built on it.

#pragma once

#include "process/reports/observer.h"
#include "process/state/run.h"

#include <string>
#include <string_view>
#include <vector>

namespace billet::process {

/// The run as it is between two increments, in bytes.
[[nodiscard]] std::string stored(const Run& run);

/// Goes on from where another run of the same scene was stored.
/// @throws Error (Fault::input_output) if the bytes are not those of such a run
void restore(Run& run, std::string_view stored);

/// Hands the run as it is now to the observers that want it. The linear solver forgets, as it has
/// where a run is resumed.
void write_checkpoint(Run& run, const std::vector<Observer*>& observers, CheckpointReason reason);

} // namespace billet::process
