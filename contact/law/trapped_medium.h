// What is trapped where metal closes a pocket on a tool: a gas that is compressed, or a lubricant
// that hardly is.
//
// Of a pocket the rest volume is known, at which its medium has the pressure of the surroundings;
// what presses on metal and tool is the pressure above that.
//
// Theory: docs/theory/contact.md (C.57).

#pragma once

#include "geometry/base/vector.h"

#include <variant>

namespace billet::contact {

/// What a medium presses with, and how that changes with the volume that it has.
struct MediumPressure {
  double pressure;  ///< above that of the surroundings [MPa]
  double by_volume; ///< d pressure / d volume, <= 0 [MPa/mm^3]
};

/// p = p0 (V0 / V)^n.
struct TrappedGas {
  double ambient = 0.1; ///< p0, absolute [MPa]
  double exponent =
      1.0; ///< n: 1 where it keeps its temperature, 1.4 for air that keeps its heat [-]

  /// @pre volume > 0
  [[nodiscard]] MediumPressure at(double rest_volume, double volume) const;

  bool operator==(const TrappedGas&) const = default;
};

/// p = K ln(V0 / V); a cavity opens where it would be pulled.
struct TrappedLubricant {
  double bulk = 0.0; ///< K [MPa]

  /// @pre volume > 0
  [[nodiscard]] MediumPressure at(double rest_volume, double volume) const;

  bool operator==(const TrappedLubricant&) const = default;
};

using TrappedMedium = std::variant<TrappedGas, TrappedLubricant>;

/// @pre volume > 0
[[nodiscard]] MediumPressure
pressure_of(const TrappedMedium& medium, double rest_volume, double volume);

} // namespace billet::contact
