// How an increment keeps the limit of penetration: certified, and pressed harder until it holds.
// (P.7)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// Whether increments are accepted only as deep as a limit allows.
[[nodiscard]] bool bounds_penetration(const Run& run);

/// Certifies how deep the attempt lies in tools, and presses harder until the limit of penetration
/// holds. Fails where it does not, or where a tool lies in the part and does not bear on it. (P.7),
/// (P.40)
Outcome<Done> limit_penetration(Run& run, double dt);

/// Keeps where a tool has been the deepest.
void note_deepest_tool(Run& run);

} // namespace billet::process
