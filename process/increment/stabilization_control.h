// A stabilization that is no stiffer than the body. (M.17)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// Solves on with a lighter stabilization while it takes more of the work than it may.
///
/// @param solved  what Newton said of the attempt
[[nodiscard]] Outcome<mechanics::NewtonReport>
with_light_stabilization(Run& run, double dt, const mechanics::NewtonReport& solved);

} // namespace billet::process
