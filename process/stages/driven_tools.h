// Tools that loads drive: whether the part holds them. (P.33)

#pragma once

#include "process/state/run.h"
#include "process/tools/drives.h"

#include <cstddef>
#include <string>
#include <vector>

namespace billet::process {

/// Before the first increment: a tool under a force lies on the part, and is not pulled off it.
/// @throws Error (Fault::case_file)
void check_drives(const Run& run);

/// Loads that drive tools at a time, and what answered them in the last try. (P.33)
[[nodiscard]] std::vector<DriveState> drive_states(const Run& run, double time);

/// What of them is known to have no answer, for the reason of a failure.
[[nodiscard]] std::string unbalanced_loads(const Run& run, double time);

} // namespace billet::process
