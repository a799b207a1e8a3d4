// Voce's saturating law.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = saturation - (saturation - yield) exp(-rate eps). (M.10e)
struct Voce {
  double yield;      ///< sigma_0 [MPa]
  double saturation; ///< sigma_s [MPa]
  double rate;       ///< b [-]

  static constexpr std::string_view name = "voce";
  static constexpr std::tuple parameters{
      Parameter{"yield", &Voce::yield, quantity::stress, allowed::positive},
      Parameter{"saturation", &Voce::saturation, quantity::stress, allowed::positive}.no_less_than(
          &Voce::yield,
          "no less than the yield stress"),
      Parameter{"rate", &Voce::rate, quantity::number, allowed::not_negative},
  };

  bool operator==(const Voce&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const double missing = (saturation - yield) * std::exp(-rate * plastic_strain);
    return {saturation - missing, rate * missing};
  }
};

} // namespace billet::mechanics
