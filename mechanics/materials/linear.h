// Linear hardening.

#pragma once

#include "mechanics/materials/flow_law.h"

namespace billet::mechanics {

/// sigma_y = yield + hardening * eps. (M.10b)
struct Linear {
  double yield;     ///< sigma_0 [MPa]
  double hardening; ///< H [MPa]

  static constexpr std::string_view name = "linear";

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    return {yield + hardening * plastic_strain, hardening};
  }
};

} // namespace billet::mechanics
