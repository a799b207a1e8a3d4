// Hensel's and Spittel's law of hot forming.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace billet::mechanics {

/// sigma = A e^(m1 T) T^m9 eps^m2 e^(m4/eps) (1+eps)^(m5 T) e^(m7 eps) rate^(m3 + m8 T). (M.28)
///
/// T in degC. Strains below `eps_min` count as that, which keeps e^(m4/eps) and eps^m2 from running
/// away where the metal begins to flow, and those above `eps_max` as that, where the measured
/// curves end: the formula goes on to fall, and flow would gather in ever thinner bands. The stress
/// is zero at rate zero unless m3 + m8 T is zero; a negative m3 + m8 T counts as zero, for a stress
/// that falls with the rate has no solution.
struct HanselSpittel {
  double A; ///< [MPa, with rates in 1/s and temperatures in degC]
  double m1, m2, m3, m4, m5, m7, m8, m9;
  double eps_min;                                           ///< [-], > 0
  double eps_max = std::numeric_limits<double>::infinity(); ///< [-], > eps_min

  static constexpr std::string_view name = "hansel-spittel";

  [[nodiscard]] RateFlowStress flow_stress(const FlowPoint& at) const noexcept {
    const double T = at.temperature;
    const double eps = std::clamp(at.plastic_strain, eps_min, eps_max);
    const double warm = A * std::exp(m1 * T) * (m9 == 0.0 ? 1.0 : std::pow(T, m9));
    const double strained =
        std::exp(m2 * std::log(eps) + m4 / eps + m5 * T * std::log1p(eps) + m7 * eps);
    const double p = sensitivity(T);
    const double rated = p == 0.0 ? 1.0 : std::pow(at.rate, p);
    const double stress = warm * strained * rated;
    const bool varies = at.plastic_strain > eps_min && at.plastic_strain < eps_max;
    const double relative = // of the slope by the strain
        varies ? m2 / eps - m4 / (eps * eps) + m5 * T / (1.0 + eps) + m7 : 0.0;
    double by_rate = 0.0;
    if (p > 0.0)
      by_rate = at.rate > 0.0 ? p * stress / at.rate : p * warm * strained * std::pow(0.0, p - 1.0);
    return {stress, relative * stress, by_rate};
  }

  /// The exponent of the rate [-].
  [[nodiscard]] double sensitivity(double temperature) const noexcept {
    return std::max(m3 + m8 * temperature, 0.0);
  }
};

} // namespace billet::mechanics
