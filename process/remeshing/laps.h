// Places where the part's boundary crosses itself.

#pragma once

#include "process/reports/lap.h"
#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// Places where the part's boundary crosses itself in creases deeper than a quarter of an
/// element.
[[nodiscard]] std::vector<Lap> laps(const Run& run);

} // namespace billet::process
