// How presses that strike go through a stage. (P.10)-(P.12)

#pragma once

#include "geometry/base/outcome.h"
#include "process/control/increment_control.h"
#include "process/scene/scene.h"
#include "process/state/run.h"

#include <optional>
#include <string>

namespace billet::process {

/// Lets the presses of a stage strike; fails where one strikes nothing.
Outcome<Done> begin_blows(Run& run, const Stage& stage);

/// First, longest and shortest increment of a stage; blows under way may ask for shorter ones.
[[nodiscard]] IncrementControl::Limits limits(const Run& run, double length);

/// Longest increment that still follows the rams; none strikes: +infinity [s]. (P.11)
[[nodiscard]] double longest_for_blows(const Run& run);

/// A shorter increment than the one just solved, if a press has turned back in it.
[[nodiscard]] std::optional<double> step_to_stop(const Run& run, double dt);

/// Whether tools, supports and loads stay what they are from a time to another.
[[nodiscard]] bool stands_still(const Run& run, const Stage& stage, double from, double to);

/// Whether the blows of a stage are over and nothing else moves in the rest of it.
[[nodiscard]] bool rests(const Run& run, const Stage& stage);

} // namespace billet::process
