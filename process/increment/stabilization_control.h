// A stabilization that is no stiffer than the body. (M.17)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// Whether the stabilization takes more of the increment just tried than it may.
[[nodiscard]] bool stabilization_weighs(const Run& run, double dt);

[[nodiscard]] Outcome<mechanics::NewtonReport>
with_light_stabilization(Run& run, double dt, const mechanics::NewtonReport& solved);

} // namespace billet::process
