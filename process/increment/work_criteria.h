// What the balance of energy says of the length of an increment. (P.23), (P.24)

#pragma once

#include "process/reports/energy_balance.h"
#include "process/state/run.h"

#include <string>

namespace billet::process {

/// What an increment just tried misses of its work; empty: no more than it may. (P.24)
///
/// @param length  of the stage [s]
[[nodiscard]] std::optional<std::string> misses_too_much(const Run& run, double dt, double length);

/// What the balance of the increment misses, as a share of its work, if the run needs better
/// ones and may choose them; else 0 [-].
///
/// @param gone  share of the stage that is behind
[[nodiscard]] double missed_since(const Run& run, const EnergyBalance& before, double gone);

/// Whether a tool's force falls so far in the increment just tried that half of its work, with
/// the force before, would spoil the balance of energy. (P.23)
[[nodiscard]] bool lets_go_too_fast(const Run& run, double dt);

} // namespace billet::process
