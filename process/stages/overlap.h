// Where the workpiece lies inside a tool, and tools in each other.

#pragma once

#include "process/setup/tool_meetings.h"
#include "process/state/run.h"

#include <cstddef>
#include <string>
#include <vector>

namespace billet::process {

/// How deep and where the workpiece lies inside a tool now; empty: no more than chords of faces
/// do.
[[nodiscard]] std::string overlap(const Run& run, std::size_t tool, double time);

/// Whether all places of a tool that are nearest to the workpiece's faces lie in the workpiece.
[[nodiscard]] bool lies_within(const Run& run, std::size_t tool, double time);

/// Likewise, of the workpiece's boundary alone.
[[nodiscard]] std::string depth_in(const Run& run, std::size_t tool, double time);

void check_overlap(const Run& run);

/// Tools that loads have driven into others, which do not feel it.
[[nodiscard]] std::vector<ToolMeeting> overlapping_tools(const Run& run);

} // namespace billet::process
