// Thermal constants of common metals, where the case gives none; a detail of io/advice.

#pragma once

#include "io/case/case.h"

#include <optional>
#include <string_view>

namespace billet::io {

/// In SI units, rounded: advice asks for orders of magnitude.
struct Metal {
  std::string_view name;
  double density;       ///< [kg/m^3]
  double heat_capacity; ///< [J/kg/K]
  double conductivity;  ///< [W/m/K]
  double melting;       ///< [degC]

  /// Thermal diffusivity [m^2/s].
  [[nodiscard]] double diffusivity() const { return conductivity / (density * heat_capacity); }
};

/// The metal that a material's density tells, or its modulus; density and heat capacity are the
/// case's where it gives them.
///
/// @return none: these constants are those of no common metal
[[nodiscard]] std::optional<Metal> metal_of(const Case& content);

} // namespace billet::io
