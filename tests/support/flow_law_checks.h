// Checks that every flow law must pass: its slope is the derivative of its value, and the stress is
// never negative.

#pragma once

#include "mechanics/materials/flow_law.h"
#include "tests/support/differences.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace billet::support {

/// Central differences are good to about eps^(2/3) when the law is smooth over the step.
inline constexpr double slope_tolerance = 1e-9;

/// Compares slope and differences at strains where the law is smooth.
template <mechanics::FlowLaw Law>
void check_slope(const Law& law, std::initializer_list<double> strains) {
  for (const double strain : strains) {
    const auto value = [&](double h) {
      return Eigen::VectorXd::Constant(1, law.flow_stress(strain + h).stress).eval();
    };
    const mechanics::FlowStress at = law.flow_stress(strain);
    EXPECT_LE(best_difference_error(value, Eigen::VectorXd::Constant(1, at.slope), strain, 1e-3),
              slope_tolerance)
        << Law::name << " at " << strain;
    EXPECT_GE(at.stress, 0.0);
  }
}

} // namespace billet::support
