// Linear hardening.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = yield + hardening * eps. (M.10b)
struct Linear {
  double yield;     ///< sigma_0 [MPa]
  double hardening; ///< H [MPa]

  static constexpr std::string_view name = "linear";
  static constexpr std::tuple parameters{
      Parameter{"yield", &Linear::yield, quantity::stress, allowed::positive},
      Parameter{"hardening", &Linear::hardening, quantity::stress, allowed::not_negative},
  };

  bool operator==(const Linear&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    return {yield + hardening * plastic_strain, hardening};
  }
};

} // namespace billet::mechanics
