// A study's quantities extrapolated over mesh and increments.
//
// Along each axis at the finest levels of the others; what the axes leave is added up.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/extrapolation.h"
#include "study/outcome_table.h"

namespace billet::study {

/// Along one axis.
struct AxisConvergence {
  std::string axis;
  std::vector<std::string> labels; ///< of the levels, shape (n)
  std::vector<double> sizes;       ///< shape (n)
  std::vector<double> values;      ///< shape (n)
  Extrapolation extrapolation;
};

/// Of one quantity at one combination of the other axes' levels.
struct Convergence {
  std::vector<std::string> problem; ///< labels of the axes that are not converged over
  std::string quantity;
  std::vector<AxisConvergence> along;
  double finest = 0.0;      ///< value at the finest levels
  double limit = 0.0;       ///< extrapolated
  double uncertainty = 0.0; ///< of the value at the finest levels
};

/// Combinations of which a run is missing are left out.
/// @pre study.convergence
[[nodiscard]] std::vector<Convergence> convergence_of(const Study& study,
                                                      const std::vector<OutcomeRow>& rows);

} // namespace billet::study
