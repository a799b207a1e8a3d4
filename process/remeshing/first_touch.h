// Whether a tool is about to touch on sides that are too long for what it will touch. (P.18)

#pragma once

#include "process/remeshing/remeshing.h"
#include "process/state/run.h"

#include <optional>

namespace billet::process {

/// A tool that will touch in the increment just solved, where nothing near touched yet, on sides
/// too long for what it touches, if there is one. (P.18)
[[nodiscard]] std::optional<FirstTouch> poor_first_touch(const Run& run, double dt);

} // namespace billet::process
