// What a number of a case measures: its dimension, its name in messages, a unit as an example.

#pragma once

#include <string_view>

namespace billet {

/// Exponents of the five base quantities.
struct Dimension {
  int length = 0;
  int force = 0;
  int time = 0;
  int temperature = 0;
  int angle = 0;

  bool operator==(const Dimension&) const = default;
};

/// What a number of the case file measures.
struct Quantity {
  std::string_view name; ///< with its article: "a length"
  Dimension dimension;
  std::string_view example; ///< "mm"
  bool takes_unit = true;   ///< false: a plain number only
  bool degrees = false;     ///< an angle counted in degrees
};

/// What the keys of a case file measure.
namespace quantity {

inline constexpr Quantity number{"a number", {}, "", false};
inline constexpr Quantity length{"a length", {1, 0, 0}, "mm"};
inline constexpr Quantity duration{"a time", {0, 0, 1}, "s"};
inline constexpr Quantity force{"a force", {0, 1, 0}, "N"};
inline constexpr Quantity torque{"a torque", {1, 1, 0}, "N*mm"};
inline constexpr Quantity energy{"an energy", {1, 1, 0}, "kJ"};
inline constexpr Quantity mass{"a mass", {-1, 1, 2}, "kg"};
inline constexpr Quantity inertia{"a moment of inertia", {1, 1, 2}, "kg*m^2"};
inline constexpr Quantity stress{"a stress", {-2, 1, 0}, "MPa"};
inline constexpr Quantity inverse_stress{"an inverse stress", {2, -1, 0}, "1/MPa"};
inline constexpr Quantity force_density{"a force per volume", {-3, 1, 0}, "N/mm^3"};
inline constexpr Quantity density{"a density", {-4, 1, 2}, "kg/m^3"};
inline constexpr Quantity heat_capacity{"a heat capacity", {2, 0, -2, -1}, "J/kg/K"};
inline constexpr Quantity speed{"a speed", {1, 0, -1}, "mm/s"};
inline constexpr Quantity rate{"a rate", {0, 0, -1}, "1/s"};
inline constexpr Quantity angular_speed{"an angular speed", {0, 0, -1, 0, 1}, "rad/s"};
inline constexpr Quantity viscosity{"a viscosity", {-2, 1, 1}, "Pa.s"};
inline constexpr Quantity temperature{"a temperature", {0, 0, 0, 1}, "degC"};
inline constexpr Quantity angle{"an angle", {0, 0, 0, 0, 1}, "deg", true, true};

} // namespace quantity

} // namespace billet
