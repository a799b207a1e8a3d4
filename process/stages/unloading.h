// How tools leave: their surfaces draw back, or their forces fade. (P.5), (P.5a)

#pragma once

#include "process/state/run.h"
#include "process/state/state.h"

#include <cstddef>

namespace billet::process {

[[nodiscard]] bool is_squeezed(const Run& run);

void put_on_retreating_surface(Run& run, std::size_t tool);

void draw_tools_back(Run& run, double until);

void draw_back_to(Run& run, double time);

void put_tools_back(Run& run);

void add_fading(Run& run, const LeavingTools::Forces& forces);

/// Lets the forces of tools that touch now and do not act at `next_time` fade until `gone_time`.
void release_tools(Run& run, double next_time, double gone_time);

} // namespace billet::process
