// Perfect plasticity.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = yield. (M.10a)
struct Perfect {
  double yield; ///< sigma_0 [MPa]

  static constexpr std::string_view name = "perfect";
  static constexpr std::tuple parameters{
      Parameter{"yield", &Perfect::yield, quantity::stress, allowed::positive},
  };

  bool operator==(const Perfect&) const = default;

  [[nodiscard]] FlowStress flow_stress(double) const noexcept { return {yield, 0.0}; }
};

} // namespace billet::mechanics
