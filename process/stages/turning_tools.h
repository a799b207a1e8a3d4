// Tools that turn while they touch. (P.51)

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// The increment, or as much of it as ends before a tool that rubs has turned so far that the way
/// of its points is no chord any more.
[[nodiscard]] double up_to_turn(const Run& run, double dt);

} // namespace billet::process
