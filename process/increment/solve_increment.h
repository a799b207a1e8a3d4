// An increment solved for: tools moved, equilibrium found, the result looked at. (P.2), (P.3)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// Linear systems solved for the attempt now made.
[[nodiscard]] int spent(const Run& run);

/// Attempts an increment, contact as it is at the end of the last one.
Outcome<Done> try_increment(Run& run, double dt, mechanics::Continuation continuation);

/// Attempts an increment, contact as it has been started for the attempt.
Outcome<Done> solve_increment(Run& run, double dt, mechanics::Continuation continuation);

} // namespace billet::process
