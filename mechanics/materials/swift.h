// Swift's power law with a pre-strain.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <cmath>

namespace billet::mechanics {

/// sigma_y = K (eps0 + eps)^n. (M.10c)
struct Swift {
  double K;    ///< [MPa]
  double eps0; ///< pre-strain [-]
  double n;    ///< exponent [-]

  static constexpr std::string_view name = "swift";

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const double stress = K * std::pow(eps0 + plastic_strain, n);
    return {stress, n * stress / (eps0 + plastic_strain)};
  }
};

} // namespace billet::mechanics
