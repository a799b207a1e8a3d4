// An elastic body: it never yields.

#pragma once

#include "mechanics/materials/flow_law.h"

#include <limits>
#include <string_view>
#include <tuple>

namespace billet::mechanics {

/// sigma_y = infinity.
struct Elastic {
  static constexpr std::string_view name = "elastic";
  static constexpr std::tuple<> parameters{};

  bool operator==(const Elastic&) const = default;

  [[nodiscard]] FlowStress flow_stress(double) const noexcept {
    return {std::numeric_limits<double>::infinity(), 0.0};
  }
};

} // namespace billet::mechanics
