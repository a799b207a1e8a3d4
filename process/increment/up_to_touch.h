// Increments that end where more of the part comes to touch a tool. (P.27)

#pragma once

#include "process/state/run.h"

#include <span>

namespace billet::process {

/// Where an increment had better end, as a share of it.
///
/// Once a point touches, all goes on in another way than it did: an increment that begins there is
/// guessed well, one that goes on far beyond is not, least of all when a second face comes down in
/// it.
///
/// @param touches  when points come to touch, as shares of the increment, ascending
[[nodiscard]] double share_up_to_touch(std::span<const double> touches);

/// The step, or as much of it as passes before more of the part comes to touch. (P.27)
[[nodiscard]] double up_to_touch(Run& run, double step);

} // namespace billet::process
