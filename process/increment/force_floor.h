// Forces that count as zero compared with the stiffness of the body. (N.2)

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// Forces below which Newton's method takes a residual for none [N]. (N.2)
[[nodiscard]] double force_floor(const Run& run, double time);

/// Whether forces are so small that they may be no more than what rounding makes of a touch.
[[nodiscard]] bool may_hardly_touch(const Run& run, double time);

/// Keeps the largest force that has acted so far.
///
/// @param of_stabilization  what the stabilization has resisted with in the increment [N]
void note_largest_force(Run& run, double of_stabilization);

} // namespace billet::process
