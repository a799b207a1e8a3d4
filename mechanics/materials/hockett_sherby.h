// Hockett's and Sherby's saturating law.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = saturation - (saturation - yield) exp(-N eps^p); the slope is infinite at eps = 0 when
/// p < 1. (M.10g)
struct HockettSherby {
  double yield;      ///< sigma_0 [MPa]
  double saturation; ///< sigma_s [MPa]
  double N;          ///< [-]
  double p;          ///< exponent [-], > 0; 1: Voce's law

  static constexpr std::string_view name = "hockett-sherby";
  static constexpr std::tuple parameters{
      Parameter{"yield", &HockettSherby::yield, quantity::stress, allowed::positive},
      Parameter{"saturation", &HockettSherby::saturation, quantity::stress, allowed::positive}
          .no_less_than(&HockettSherby::yield, "no less than the yield stress"),
      Parameter{"N", &HockettSherby::N, quantity::number, allowed::not_negative},
      Parameter{"p", &HockettSherby::p, quantity::number, allowed::positive},
  };

  bool operator==(const HockettSherby&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const double missing = (saturation - yield) * std::exp(-N * std::pow(plastic_strain, p));
    if (N == 0.0 || missing == 0.0) // the power may be infinite
      return {saturation - missing, 0.0};
    return {saturation - missing, missing * N * p * std::pow(plastic_strain, p - 1.0)};
  }
};

} // namespace billet::mechanics
