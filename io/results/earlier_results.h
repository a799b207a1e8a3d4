// What a folder of results holds from before, and what of it goes where a run begins or goes on.
//
// Files that no run writes stay.

#pragma once

#include <filesystem>
#include <string>

namespace billet::io {

/// Removes what writers that were killed have left half-written.
void remove_partial_files(const std::filesystem::path& folder);

/// Removes frames from a number on, what a run leaves when it ends, and lists of its frames by
/// another name than that of the case that goes on.
void remove_later(const std::filesystem::path& folder, int first_frame, const std::string& name);

/// Removes what an earlier run left, so that nothing of it passes for a result of this one.
/// @throws Error (Fault::input_output) if something cannot be removed
void remove_earlier_run(const std::filesystem::path& folder);

} // namespace billet::io
