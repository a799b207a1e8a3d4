// Johnson's and Cook's law: hardening, rate and temperature as factors.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <algorithm>
#include <cmath>

namespace billet::mechanics {

/// sigma = (A + B eps^n) (1 + C ln(rate / rate0)+) (1 - T*^m), T* = (T - T_room) / (T_melt -
/// T_room). (M.27)
///
/// Rates below rate0 count as rate0 and temperatures below T_room as T_room. The last factor does
/// not fall below `melt_floor`: a body without any strength has no equilibrium to be found.
struct JohnsonCook {
  double A;      ///< [MPa]
  double B;      ///< [MPa]
  double n;      ///< [-]
  double C;      ///< [-]
  double rate0;  ///< [1/s], > 0
  double m;      ///< [-], > 0
  double T_room; ///< [degC]
  double T_melt; ///< [degC], > T_room

  static constexpr std::string_view name = "johnson-cook";
  /// Share of the strength at T_room that is left at T_melt and above [-].
  static constexpr double melt_floor = 1e-6;

  [[nodiscard]] RateFlowStress flow_stress(const FlowPoint& at) const noexcept {
    const double power = n == 0.0 ? 1.0 : std::pow(at.plastic_strain, n);
    const double soft = softening(at.temperature);
    const double rise = at.rate > rate0 ? C * std::log(at.rate / rate0) : 0.0;
    const double slope = n == 0.0 || B == 0.0 ? 0.0 : B * n * std::pow(at.plastic_strain, n - 1.0);
    const double hardened = soft * (A + B * power);
    return {hardened * (1.0 + rise), soft * slope * (1.0 + rise),
            at.rate > rate0 ? hardened * C / at.rate : 0.0};
  }

  /// The factor of the temperature [-].
  [[nodiscard]] double softening(double temperature) const noexcept {
    const double T = std::clamp((temperature - T_room) / (T_melt - T_room), 0.0, 1.0);
    return std::max(1.0 - std::pow(T, m), melt_floor);
  }
};

} // namespace billet::mechanics
