// Norton's and Hoff's viscoplastic power law.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma = yield + sqrt(3) K (sqrt(3) rate)^m (eps0 + eps)^n. (M.25)
///
/// With m < 1 the slope by the rate is infinite at rate zero; without `yield` the metal flows under
/// any stress.
struct NortonHoff {
  double K;           ///< consistency [MPa s^m]
  double m;           ///< sensitivity to the rate [-], in (0, 1]
  double n = 0.0;     ///< hardening exponent [-]
  double eps0 = 0.0;  ///< pre-strain [-]
  double yield = 0.0; ///< sigma_0 [MPa], >= 0

  static constexpr std::string_view name = "norton-hoff";
  static constexpr std::tuple parameters{
      Parameter{"K", &NortonHoff::K, quantity::stress, allowed::positive},
      Parameter{"m", &NortonHoff::m, quantity::number, allowed::positive_fraction},
      Parameter{"n", &NortonHoff::n, quantity::number, allowed::not_negative}.or_absent(),
      Parameter{"eps0", &NortonHoff::eps0, quantity::number, allowed::not_negative}.or_absent(),
      Parameter{"yield", &NortonHoff::yield, quantity::stress, allowed::not_negative}.or_absent(),
  };

  bool operator==(const NortonHoff&) const = default;

  [[nodiscard]] RateFlowStress flow_stress(const FlowPoint& at) const noexcept {
    const double strain = eps0 + at.plastic_strain;
    const double hardened =
        n == 0.0 ? std::numbers::sqrt3 * K : std::numbers::sqrt3 * K * std::pow(strain, n);
    const double x = std::numbers::sqrt3 * at.rate;
    const double power = std::pow(x, m);
    const double over = hardened * power;
    if (over == 0.0)
      return {yield, 0.0, hardened == 0.0 ? 0.0 : slope_at_rest(hardened)};
    return {yield + over, n == 0.0 ? 0.0 : n * over / strain, m * over / at.rate};
  }

private:
  [[nodiscard]] double slope_at_rest(double hardened) const noexcept {
    return std::numbers::sqrt3 * hardened * m * std::pow(0.0, m - 1.0);
  }
};

} // namespace billet::mechanics
