// Johnson's and Cook's law: hardening, rate and temperature as factors.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma = (A + B eps^n) (1 + C ln(rate / rate0)+) (1 - T*^m), T* = (T - T_room) / (T_melt -
/// T_room). (M.27)
///
/// Rates below rate0 count as rate0 and temperatures below T_room as T_room. The last factor does
/// not fall below `melt_floor`: a body without any flow stress has no equilibrium to be found.
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
  static constexpr std::tuple parameters{
      Parameter{"A", &JohnsonCook::A, quantity::stress, allowed::positive},
      Parameter{"B", &JohnsonCook::B, quantity::stress, allowed::not_negative},
      Parameter{"n", &JohnsonCook::n, quantity::number, allowed::not_negative},
      Parameter{"C", &JohnsonCook::C, quantity::number, allowed::not_negative},
      Parameter{"rate0", &JohnsonCook::rate0, quantity::rate, allowed::positive},
      Parameter{"m", &JohnsonCook::m, quantity::number, allowed::positive},
      Parameter{"T_room", &JohnsonCook::T_room, quantity::temperature,
                allowed::above_absolute_zero},
      Parameter{"T_melt", &JohnsonCook::T_melt, quantity::temperature, allowed::above_absolute_zero}
          .more_than(&JohnsonCook::T_room, "more than T_room ="),
  };
  /// Share of the flow stress at T_room that is left at T_melt and above [-].
  static constexpr double melt_floor = 1e-6;

  bool operator==(const JohnsonCook&) const = default;

  [[nodiscard]] RateFlowStress flow_stress(const FlowPoint& at) const noexcept {
    const double power = n == 0.0 ? 1.0 : std::pow(at.plastic_strain, n);
    const double soft = softening(at.temperature);
    const double rise = at.rate > rate0 ? C * std::log(at.rate / rate0) : 0.0;
    const double slope = n == 0.0 || B == 0.0 ? 0.0 : B * n * std::pow(at.plastic_strain, n - 1.0);
    const double hardened = soft * (A + B * power);
    return {hardened * (1.0 + rise), soft * slope * (1.0 + rise),
            at.rate > rate0 ? hardened * C / at.rate : 0.0};
  }

  [[nodiscard]] bool asks_temperature() const noexcept { return true; }

  /// The factor of the temperature [-].
  [[nodiscard]] double softening(double temperature) const noexcept {
    const double T = std::clamp((temperature - T_room) / (T_melt - T_room), 0.0, 1.0);
    return std::max(1.0 - std::pow(T, m), melt_floor);
  }
};

} // namespace billet::mechanics
