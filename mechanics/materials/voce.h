// Voce's saturating law.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <cmath>

namespace billet::mechanics {

/// sigma_y = saturation - (saturation - yield) exp(-rate eps). (M.10e)
struct Voce {
  double yield;      ///< sigma_0 [MPa]
  double saturation; ///< sigma_s [MPa]
  double rate;       ///< b [-]

  static constexpr std::string_view name = "voce";

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const double missing = (saturation - yield) * std::exp(-rate * plastic_strain);
    return {saturation - missing, rate * missing};
  }
};

} // namespace billet::mechanics
