// Checks that every flow law must pass: its slope is the derivative of its value, and the stress is
// never negative.

#pragma once

#include "mechanics/materials/flow_law.h"
#include "tests/support/differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace billet::support {

/// Central differences are good to about eps^(2/3) when the law is smooth over the step.
inline constexpr double slope_tolerance = 1e-9;

/// Compares both slopes of a rate law with differences at points where it is smooth.
template <mechanics::RateFlowLaw Law>
void check_slopes(const Law& law, std::initializer_list<mechanics::FlowPoint> points) {
  using mechanics::FlowPoint;
  for (const FlowPoint& at : points) {
    const auto error = [&](double FlowPoint::*along, double slope) {
      const auto value = [&](double h) {
        FlowPoint moved = at;
        moved.*along += h;
        return Eigen::VectorXd::Constant(1, law.flow_stress(moved).stress).eval();
      };
      const double floor = 0.1 * law.flow_stress(at).stress / (at.*along);
      return best_difference_error(value, Eigen::VectorXd::Constant(1, slope), at.*along, floor);
    };
    const mechanics::RateFlowStress flow = law.flow_stress(at);
    EXPECT_GE(flow.stress, 0.0);
    EXPECT_GE(flow.rate_slope, 0.0);
    EXPECT_LE(error(&FlowPoint::plastic_strain, flow.slope), slope_tolerance)
        << Law::name << " by the strain at " << at.plastic_strain << ", rate " << at.rate;
    EXPECT_LE(error(&FlowPoint::rate, flow.rate_slope), slope_tolerance)
        << Law::name << " by the rate at " << at.plastic_strain << ", rate " << at.rate;
  }
}

/// No NaN and no negative stress anywhere, from rest to absurd rates and temperatures.
template <mechanics::RateFlowLaw Law>
void check_everywhere(const Law& law, std::initializer_list<double> temperatures) {
  for (const double T : temperatures)
    for (const double strain : {0.0, 1e-300, 1e-12, 1e-3, 0.3, 5.0})
      for (double rate = 1e-20; rate < 1e21; rate *= 10.0)
        for (const double at : {0.0, rate}) {
          const mechanics::RateFlowStress flow = law.flow_stress({strain, at, T});
          EXPECT_GE(flow.stress, 0.0) << Law::name << " " << strain << " " << at << " " << T;
          EXPECT_TRUE(std::isfinite(flow.stress));
          EXPECT_FALSE(std::isnan(flow.slope)) << Law::name << " " << strain << " " << at;
          EXPECT_GE(flow.rate_slope, 0.0) << Law::name << " " << strain << " " << at;
        }
}

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
