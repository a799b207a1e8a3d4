// Tabulated hardening.

#pragma once

#include "geometry/base/parameter.h"
#include "mechanics/materials/flow_law.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace billet::mechanics {

/// Linear between points (plastic strain, yield stress), the last value kept. (M.10f)
struct FlowTable {
  std::vector<std::pair<double, double>> points; ///< strains strictly increasing from 0 [-, MPa]

  static constexpr std::string_view name = "table";
  static constexpr std::tuple parameters{
      Parameter{"points", &FlowTable::points, quantity::stress, allowed::positive},
  };

  bool operator==(const FlowTable&) const = default;

  [[nodiscard]] FlowStress flow_stress(double plastic_strain) const noexcept {
    const auto above = std::upper_bound(
        points.begin(), points.end(), plastic_strain,
        [](double strain, const std::pair<double, double>& point) { return strain < point.first; });
    if (above == points.end())
      return {points.empty() ? 0.0 : points.back().second, 0.0};
    if (above == points.begin())
      return {points.front().second, 0.0};
    const auto& [e0, s0] = *std::prev(above);
    const auto& [e1, s1] = *above;
    const double slope = (s1 - s0) / (e1 - e0);
    return {s0 + slope * (plastic_strain - e0), slope};
  }
};

} // namespace billet::mechanics
