// Where the workpiece lies inside a tool, and tools in each other.

#pragma once

#include "process/setup/tool_meetings.h"
#include "process/state/run.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace billet::process {

/// How deep and where the workpiece lies inside a tool now, if by more than chords of faces do.
[[nodiscard]] std::optional<std::string> overlap(const Run& run, std::size_t tool, double time);

/// No tool that acts from the start may lie in the workpiece.
/// @throws Error (Fault::geometry) naming all that do
void check_overlap(const Run& run);

/// Tools that loads have driven into others, which do not feel it.
[[nodiscard]] std::vector<ToolMeeting> overlapping_tools(const Run& run);

} // namespace billet::process
