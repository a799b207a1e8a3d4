// Whether metal is squeezed because it has no way out.
//
// Under the pressures of forming metal loses little of its volume, and more of it the softer its
// elasticity is compared with its strength: a loss of volume alone says nothing. In an open die the
// average pressure is a few flow stresses, by friction; where the cavity is full it rises without
// limit. (P.43)

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// What the metal is under as a whole.
struct Squeeze {
  double volume_lost = 0.0; ///< share of its volume without pressure [-]
  double pressure = 0.0;    ///< that takes, on average over the part [MPa]
  double flow_stress = 0.0; ///< on average over the part [MPa]
  /// Largest of the tools, each on average where it touches [MPa].
  double tool_pressure = 0.0;

  static constexpr double little = 0.01; ///< share of the volume: what does no harm
  /// The same where an increment cannot be solved: a cavity of soft metal is full with no more.
  static constexpr double little_at_failure = 0.5 * little;

  /// Whether the metal has no way out, or too little.
  [[nodiscard]] bool is_full() const;
  /// Whether it has hardly any left.
  [[nodiscard]] bool is_nearly_full() const;
};

/// Whether more than a share of the volume is gone: where it is not, no cavity is full.
///
/// @param volume  of the workpiece now [mm^3]
[[nodiscard]] bool has_lost_volume(const Run& run, double volume, double share = Squeeze::little);

/// @param volume  of the workpiece now [mm^3]
[[nodiscard]] Squeeze squeeze_of(const Run& run, double volume);

} // namespace billet::process
