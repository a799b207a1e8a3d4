// Forces of tools that leave without drawing back: dead loads that fade. (P.5a)

#pragma once

#include "process/state/run.h"

namespace billet::process {

struct Stage;

/// Whether a tool that touches does not act any more in an increment that begins now.
[[nodiscard]] bool tools_leave(const Run& run, const Stage& stage);

/// When the forces of tools that leave now are gone: before other tools, supports or presses have
/// gone farther than a ten-thousandth of the part, loads have changed, or rate-dependent metal
/// flows [s].
[[nodiscard]] double faded_at(const Run& run, const Stage& stage);

} // namespace billet::process
