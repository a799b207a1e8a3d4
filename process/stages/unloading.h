// How tools leave: their surfaces draw back, or their forces fade. (P.5), (P.5a)

#pragma once

#include "process/state/run.h"
#include "process/state/state.h"

#include <cstddef>

namespace billet::process {

/// Puts a tool's surface into one that draws back.
void put_on_retreating_surface(Run& run, std::size_t tool);

/// Begins to draw back the tools that touch, until a time; what they only bend they let go at once.
/// (P.5)
void draw_tools_back(Run& run, double until);

/// Draws back as far as at a time of the attempt.
void draw_back_to(Run& run, double time);

/// Tools that rest are where their motions take them again: a stage begins in which they work.
void set_tools_going(Run& run);

/// Ends drawing back at the end of the stage: none acts until a stage says which.
void let_tools_go(Run& run);

/// Hastens what has begun, to be done by then: a run that is resumed may end its stage earlier.
/// @throws Error (Fault::case_file) if that is now, and it is not done
void end_unloading_by(Run& run, double end);

/// Forces of a tool that has left, as a load that fades. (P.5a)
void add_decaying(Run& run, const LeavingTools::Forces& forces);

/// Lets the forces of tools that touch now and do not act at `next_time` fade until `gone_time`.
void release_tools(Run& run, double next_time, double gone_time);

} // namespace billet::process
