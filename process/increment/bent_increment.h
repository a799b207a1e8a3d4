// Increments in which the load curve bends: at first yield, at first touch. (P.24a)
//
// The work of forces is summed by trapezoids, and in the first increment of a run, from nothing to
// metal that flows, a trapezoid sees half of the force. Such an increment is solved again in two
// parts, up to the bend and on from there, and those after it are as long as if it had not been.
// Only where the part as a whole is stressed: where contact begins at a place, as between rolls or
// beneath a wedge, there is far more work to come. What is done about bends that come later stands
// with (P.24).
//
// Theory: docs/theory/process.md.

#pragma once

#include "process/state/run.h"

#include <optional>
#include <string>

namespace billet::process {

/// A bend of the load curve.
struct Bend {
  double share;    ///< of the increment, that ends there [-]
  std::string why; ///< the increment needs parts
};

/// Where the load curve of an increment bends that begins with no force, as a share of it.
///
/// The curve as two straight lines: from nothing up to a force that stays what it is, or nothing
/// at first and then up to a force. In whole 64ths, an eighth at least and seven at most.
///
/// @param trapezoid  half of the last force times the way [N mm]
/// @param work       found in the metal and on its surface [N mm]
[[nodiscard]] double bend_from_nothing(double trapezoid, double work);

/// Where the load curve bends so within an early increment just tried that its work is missed.
///
/// @param length    of the stage [s]
/// @param shortest  that a part may be [s]
[[nodiscard]] std::optional<Bend>
bend_within(const Run& run, double dt, double length, double shortest);

} // namespace billet::process
