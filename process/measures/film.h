// Metal between two tools that is about to be squeezed to nothing.
//
// Prescribed motions may carry one tool through another. Where metal lies between them it becomes
// ever thinner, and increments shorter, without an end: from some thickness on what is computed is
// no process any more. (P.44)

#pragma once

#include "process/state/run.h"

#include <cstddef>
#include <optional>

namespace billet::process {

/// A place where the part lies between two tools that come nearer to each other.
struct Film {
  std::size_t first = 0, second = 0; ///< tools
  Vec3 place = Vec3::Zero();         ///< on the first [mm]
  double thickness = 0.0;            ///< [mm]
};

/// The thinnest that is thinner than a small share of the part at the start, of points that touch
/// one tool and face another across the metal; none.
///
/// @param dt  the last increment, in which the tools have come nearer [s]
[[nodiscard]] std::optional<Film> closing_film(const Run& run, double dt);

} // namespace billet::process
