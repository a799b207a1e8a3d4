// Hensel's and Spittel's law of hot forming.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

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
  double m1 = 0.0, m2 = 0.0, m3 = 0.0, m4 = 0.0, m5 = 0.0, m7 = 0.0, m8 = 0.0, m9 = 0.0;
  double eps_min = 0.01;                                    ///< [-], > 0
  double eps_max = std::numeric_limits<double>::infinity(); ///< [-], > eps_min
  double m6 = 0.0; ///< reserved by the numbering of the formula

  static constexpr std::string_view name = "hansel-spittel";
  static constexpr std::tuple parameters{
      Parameter{"A", &HanselSpittel::A, quantity::stress, allowed::positive},
      Parameter{"m1", &HanselSpittel::m1}.or_absent(),
      Parameter{"m2", &HanselSpittel::m2}.or_absent(),
      Parameter{"m3", &HanselSpittel::m3}.or_absent(),
      Parameter{"m4", &HanselSpittel::m4}.or_absent(),
      Parameter{"m5", &HanselSpittel::m5}.or_absent(),
      Parameter{"m6", &HanselSpittel::m6, quantity::number, Bounds{0.0, 0.0}}.or_absent(),
      Parameter{"m7", &HanselSpittel::m7}.or_absent(),
      Parameter{"m8", &HanselSpittel::m8}.or_absent(),
      Parameter{"m9", &HanselSpittel::m9}.or_absent(),
      Parameter{"eps_min", &HanselSpittel::eps_min, quantity::number, allowed::positive}.optional(),
      Parameter{"eps_max", &HanselSpittel::eps_max, quantity::number, allowed::positive}
          .or_absent()
          .more_than(&HanselSpittel::eps_min, "more than eps_min ="),
  };

  bool operator==(const HanselSpittel&) const = default;

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

  [[nodiscard]] bool asks_temperature() const noexcept {
    return m1 != 0.0 || m5 != 0.0 || m8 != 0.0 || m9 != 0.0;
  }

  /// The exponent of the rate [-].
  [[nodiscard]] double sensitivity(double temperature) const noexcept {
    return std::max(m3 + m8 * temperature, 0.0);
  }
};

} // namespace billet::mechanics
