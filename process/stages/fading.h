// Forces of tools that leave without drawing back: dead loads that fade. (P.5a)

#pragma once

#include "process/state/run.h"

#include <optional>

namespace billet::process {

struct Stage;

/// So soon after now that tools which do not act then are those that leave now, if any does; none:
/// no tool leaves. [s]
[[nodiscard]] std::optional<double> tools_leave(const Run& run, const Stage& stage);

/// When the forces of tools that leave now, in a stage without `unload`, are gone: before other
/// tools, supports or presses have gone farther than a ten-thousandth of the part, loads have
/// changed, or rate-dependent metal flows [s].
[[nodiscard]] double faded_at(const Run& run, const Stage& stage);

} // namespace billet::process
