#include "contact/law/trapped_medium.h"
#include "tests/support/differences.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::contact::trapped_medium_test {
namespace {

double slope_error(const TrappedMedium& medium, double rest, double volume) {
  return support::best_difference_error(
      [&](double h) {
        return Eigen::VectorXd::Constant(1, pressure_of(medium, rest, volume + h).pressure);
      },
      Eigen::VectorXd::Constant(1, pressure_of(medium, rest, volume).by_volume), volume);
}

TEST(TrappedMedium, GasOfHalfTheVolumeHasTwiceThePressure) {
  const TrappedMedium gas = TrappedGas{0.1, 1.0};
  EXPECT_DOUBLE_EQ(pressure_of(gas, 6.0, 6.0).pressure, 0.0);
  EXPECT_DOUBLE_EQ(pressure_of(gas, 6.0, 3.0).pressure, 0.1); // absolute 0.2
  EXPECT_DOUBLE_EQ(pressure_of(gas, 6.0, 12.0).pressure, -0.05);
  EXPECT_LT(slope_error(gas, 6.0, 2.0), 1e-8);
}

TEST(TrappedMedium, GasThatKeepsItsHeatIsStiffer) {
  const TrappedMedium gas = TrappedGas{0.1, 1.4};
  EXPECT_NEAR(pressure_of(gas, 6.0, 3.0).pressure, 0.1 * (std::pow(2.0, 1.4) - 1.0), 1e-15);
  EXPECT_LT(slope_error(gas, 6.0, 2.0), 1e-8);
}

TEST(TrappedMedium, LubricantIsPressedButNotPulled) {
  const TrappedMedium oil = TrappedLubricant{1500.0};
  EXPECT_NEAR(pressure_of(oil, 1.0, 0.99).pressure, -1500.0 * std::log(0.99), 1e-12);
  EXPECT_LT(slope_error(oil, 1.0, 0.9), 1e-8);
  EXPECT_EQ(pressure_of(oil, 1.0, 1.5).pressure, 0.0);
  EXPECT_EQ(pressure_of(oil, 1.0, 1.5).by_volume, 0.0);
}

} // namespace
} // namespace billet::contact::trapped_medium_test
