// The part on a new mesh. (P.14)

#pragma once

#include "process/remeshing/remeshing.h"
#include "process/state/run.h"

#include <vector>

namespace billet::process {

/// The part on a new mesh; nothing of the run has changed.
///
/// @param at  sizes besides, in the plane
/// @throws Error(Fault::geometry) if it cannot be meshed
[[nodiscard]] NewPart new_part(const Run& run, const std::vector<geometry::SizeAt>& at);

} // namespace billet::process
