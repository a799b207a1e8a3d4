// Whether an increment that Newton's method has solved may be accepted. (P.3), (P.9), (P.41)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// Whether the attempt turns no element inside out that was not, or was less so.
Outcome<Done> check_shape(Run& run);

/// Whether the attempt carries the workpiece through no tool. (P.9), (P.41)
Outcome<Done> check_passages(const Run& run, double dt);

/// All that a solved attempt is asked: nothing moves away, no tool is passed or lies too deep, no
/// element turns inside out.
///
/// @param force_scale  that Newton's residual was compared with [N]
Outcome<Done> check_solution(Run& run, double dt, double force_scale);

} // namespace billet::process
