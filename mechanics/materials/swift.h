// Swift's power law with a pre-strain.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = K (eps0 + eps)^n. (M.10c)
struct Swift {
  double K;    ///< [MPa]
  double eps0; ///< pre-strain [-]
  double n;    ///< exponent [-]

  static constexpr std::string_view name = "swift";
  static constexpr std::tuple parameters{
      Parameter{"K", &Swift::K, quantity::stress, allowed::positive},
      Parameter{"eps0", &Swift::eps0, quantity::number, allowed::positive},
      Parameter{"n", &Swift::n, quantity::number, allowed::not_negative},
  };

  bool operator==(const Swift&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const double stress = K * std::pow(eps0 + plastic_strain, n);
    return {stress, n * stress / (eps0 + plastic_strain)};
  }
};

} // namespace billet::mechanics
