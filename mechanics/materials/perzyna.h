// Perzyna's overstress law on top of a law that knows no rate.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/any_static_law.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// rate = <sigma / sigma_y - 1>^(1/m) / eta, that is sigma = sigma_y (1 + (eta rate)^m). (M.26)
///
/// With eta -> 0 the rate-independent law `base` remains.
struct Perzyna {
  AnyStaticLaw base; ///< sigma_y
  double eta;        ///< [s], > 0
  double m;          ///< [-], > 0

  static constexpr std::string_view name = "perzyna";
  static constexpr std::tuple parameters{
      Parameter{"eta", &Perzyna::eta, quantity::duration, allowed::positive},
      Parameter{"m", &Perzyna::m, quantity::number, allowed::positive},
      Parameter{"base", &Perzyna::base},
  };

  bool operator==(const Perzyna&) const = default;

  [[nodiscard]] RateFlowStress flow_stress(const FlowPoint& at) const noexcept {
    const FlowStress yield = static_stress(base, at.plastic_strain);
    const double x = eta * at.rate;
    const double power = std::pow(x, m);
    const double by_rate = x > 0.0 ? m * power / at.rate : m * eta * std::pow(0.0, m - 1.0);
    return {yield.stress * (1.0 + power), yield.slope * (1.0 + power), yield.stress * by_rate};
  }
};

} // namespace billet::mechanics
