// A coefficient given point by point over pressure, sliding speed and sliding distance.
//
// Linear between the points along every axis, constant outside (F.11). An axis that is not given
// does not matter.

#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace billet::contact {

/// A coefficient and its exact partial derivatives.
struct Coefficient {
  double value = 1.0;      ///< [-]
  double d_pressure = 0.0; ///< [1/MPa]
  double d_speed = 0.0;    ///< [s/mm]
  double d_sliding = 0.0;  ///< [1/mm]
};

/// Where a coefficient is asked for.
struct CoefficientPoint {
  double pressure; ///< [MPa]
  double speed;    ///< of sliding [mm/s]
  double sliding;  ///< distance [mm]
};

/// Multilinear interpolation on a grid.
class CoefficientTable {
public:
  /// The constant 1.
  CoefficientTable() = default;
  /// @param axes    pressure, speed, sliding distance: increasing; empty: does not matter
  /// @param values  of all grid points, the last axis running fastest
  /// @throws std::invalid_argument when sizes do not fit or an axis does not increase
  CoefficientTable(std::array<std::vector<double>, 3> axes, std::vector<double> values);

  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] bool depends_on_speed() const { return axes_[1].size() > 1; }
  [[nodiscard]] bool depends_on_sliding() const { return axes_[2].size() > 1; }

  [[nodiscard]] Coefficient operator()(const CoefficientPoint& at) const;

private:
  std::array<std::vector<double>, 3> axes_;
  std::vector<double> values_; ///< empty: the constant 1
};

} // namespace billet::contact
