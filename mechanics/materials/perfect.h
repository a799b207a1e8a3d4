// Perfect plasticity.

#pragma once

#include "mechanics/materials/flow_law.h"

namespace billet::mechanics {

/// sigma_y = yield. (M.10a)
struct Perfect {
  double yield; ///< sigma_0 [MPa]

  static constexpr std::string_view name = "perfect";

  [[nodiscard]] FlowStress flow_stress(double) const noexcept { return {yield, 0.0}; }
};

} // namespace billet::mechanics
