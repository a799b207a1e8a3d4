// How a run was started: RESULTS/starts.json, for `billet report` and whoever finds the results
// later.

#pragma once

#include <filesystem>

namespace billet::app {

/// Writes when, where and with which command the run was started. Of a run that is resumed the
/// earlier starts stay in the list.
/// @throws Error  (Fault::input_output)
void note_start(const std::filesystem::path& folder, int threads, bool resumed);

} // namespace billet::app
