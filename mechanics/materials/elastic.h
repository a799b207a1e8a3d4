// An elastic body: it never yields.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <limits>

namespace billet::mechanics {

/// sigma_y = infinity.
struct Elastic {
  static constexpr std::string_view name = "elastic";

  [[nodiscard]] FlowStress flow_stress(double) const noexcept {
    return {std::numeric_limits<double>::infinity(), 0.0};
  }
};

} // namespace billet::mechanics
