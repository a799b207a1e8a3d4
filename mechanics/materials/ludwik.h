// Ludwik's power law.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <cmath>

namespace billet::mechanics {

/// sigma_y = yield + K eps^n; the slope is infinite at eps = 0 when n < 1. (M.10d)
struct Ludwik {
  double yield; ///< sigma_0 [MPa]
  double K;     ///< [MPa]
  double n;     ///< exponent [-]

  static constexpr std::string_view name = "ludwik";

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    if (n == 0.0)
      return {yield + K, 0.0};
    return {yield + K * std::pow(plastic_strain, n), n * K * std::pow(plastic_strain, n - 1.0)};
  }
};

} // namespace billet::mechanics
