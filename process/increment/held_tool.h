// An increment in which the place of a tool that a load drives is looked for.
//
// Where facets or friction change from iteration to iteration the tool's own equation carries every
// change to all points at once, and the iteration goes round in circles. With the tool held in a
// place the part finds its equilibrium as under a prescribed motion, and what it bears there says
// on which side of that place the load is borne. (P.32)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

#include <optional>

namespace billet::process {

/// Attempts an increment with the tool that a load drives held in one place after the other, until
/// the part bears the load. (P.32)
/// @return none: more tools are driven than one, or none, or no such place has been found
[[nodiscard]] std::optional<Outcome<Done>> held_tool(Run& run, double dt);

} // namespace billet::process
