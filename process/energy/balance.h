// The balance of energy of a run. (P.6)

#pragma once

#include "process/reports/energy_balance.h"
#include "process/state/run.h"

namespace billet::process {

/// In the increment just tried [N mm].
[[nodiscard]] double work_of_supports(const Run& run, double dt);

/// Sums the balance up anew, as it is at the end of an accepted increment.
void update_energy(Run& run);

/// What the balance would be with the increment just tried; nothing changes.
[[nodiscard]] EnergyBalance energy_after(const Run& run, double dt);

/// Work that says nothing: no increment is refused for it. [N mm]
[[nodiscard]] double work_of_rounding(const Run& run);

} // namespace billet::process
