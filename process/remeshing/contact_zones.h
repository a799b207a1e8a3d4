// Zones of contact in the plane: where tools touch, and on how many edges.

#pragma once

#include "process/remeshing/part_boundary.h"
#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// The tool that touches each contact face; -1: none.
[[nodiscard]] std::vector<int> touching_tools(const Run& run);

/// Where tools touch now; in the plane only.
[[nodiscard]] std::vector<ContactZone> zones_of_contact(const Run& run);

/// Whether what a tool does in a zone is to indent: pressure near the flow stress there, or an
/// indentation that takes part in the work.
[[nodiscard]] bool indents(const Run& run, const ContactZone& zone);

/// Tools that touch in too short zones only: their forces can be far too high.
[[nodiscard]] std::vector<ContactZone> poorly_resolved_tools(const Run& run);

} // namespace billet::process
