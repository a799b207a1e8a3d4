// Unknowns that supports prescribe, and unknowns as they are predicted. (P.2)

#pragma once

#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// What supports prescribe at a time, and walls of symmetry to which metal has come.
[[nodiscard]] mechanics::Prescribed prescribed_by_supports(const Run& run, double time);

/// The same, and where presses are that are led at that time.
[[nodiscard]] mechanics::Prescribed prescribed(const Run& run, double time);

/// Unknowns after `dt` more if all goes on as in the last increment, seen from the first guess.
[[nodiscard]] std::vector<double> predicted(const Run& run, double dt);

} // namespace billet::process
