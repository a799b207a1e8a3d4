// Ludwik's power law.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = yield + K eps^n; the slope is infinite at eps = 0 when n < 1. (M.10d)
struct Ludwik {
  double yield; ///< sigma_0 [MPa]
  double K;     ///< [MPa]
  double n;     ///< exponent [-]

  static constexpr std::string_view name = "ludwik";
  static constexpr std::tuple parameters{
      Parameter{"yield", &Ludwik::yield, quantity::stress, allowed::positive},
      Parameter{"K", &Ludwik::K, quantity::stress, allowed::not_negative},
      Parameter{"n", &Ludwik::n, quantity::number, allowed::positive},
  };

  bool operator==(const Ludwik&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    if (n == 0.0)
      return {yield + K, 0.0};
    return {yield + K * std::pow(plastic_strain, n), n * K * std::pow(plastic_strain, n - 1.0)};
  }
};

} // namespace billet::mechanics
