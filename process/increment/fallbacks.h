// Other ways to a solution, after an increment has failed. (N.10), (P.32)

#pragma once

#include "geometry/base/outcome.h"
#include "process/state/run.h"

namespace billet::process {

/// How far the search for an increment has gone.
struct Difficulty {
  bool failed_before = false; ///< longer ones have failed, or there are none: a way round may pay
  bool last_way = false;      ///< shorter ones have been in vain, or there are none
  bool keeps_failing = false; ///< driven tools may be held in places
};

/// Attempts an increment directly, then by every way that applies, from the cheapest on.
/// @return why the last of them failed
Outcome<Done> solve_by_any_way(Run& run, double dt, const Difficulty& difficulty);

} // namespace billet::process
