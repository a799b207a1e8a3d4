// An increment accepted: the trial becomes the state of the run.

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// Makes the trial the state of the run.
void commit(Run& run, double dt);

/// Accepts the attempt: commits it, and takes it into the sums, records and snapshots of the run.
///
/// @param dt  its length [s]
void accept(Run& run, double dt);

} // namespace billet::process
