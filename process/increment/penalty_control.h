// The penalty of contact, softer where iterations are many and penetrations needlessly small.
// (C.24)

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// How an increment has gone.
enum class Progress {
  easy,
  laboured, ///< many iterations, or a try that failed
  none      ///< tries keep failing
};

/// Takes a softer penalty where iterations are many and penetrations needlessly small, and back.
void adapt_penalty(Run& run, Progress progress);

} // namespace billet::process
