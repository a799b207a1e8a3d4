// The part on a new mesh. (P.14)

#pragma once

#include "process/remeshing/remeshing.h"
#include "process/state/run.h"

namespace billet::process {

/// The part on a new mesh; nothing of the run has changed.
///
/// @throws Error(Fault::geometry) if it cannot be meshed
[[nodiscard]] NewPart new_part(const Run& run, const AskedSizes& asked);

} // namespace billet::process
