#include "contact/friction/coulomb.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace billet::contact::coulomb_test {
namespace {

constexpr double k = 300.0; // FRI-02: shear yield of the spot values [MPa]

TEST(Coulomb, HasTheSpotValuesOfThePaper) {
  // VALIDATION FRI-02: phi = .15, p = 1000: eq 3 150; eq 4 with sigma_A = 100 135.
  EXPECT_DOUBLE_EQ((Coulomb{0.15}.slip_limit({1000.0, k}).shear), 150.0);
  EXPECT_DOUBLE_EQ((Coulomb{0.15, 100.0, k}.slip_limit({1000.0, k}).shear), 135.0);
}

TEST(Coulomb, HasTheSpotValuesOfSecondOrder) {
  // VALIDATION FRI-02, eq 5: phi_1 = .15, phi_2 = 2e-4 / MPa, capped at k.
  const Coulomb law{0.15, 0.0, k, 2e-4};
  const Coulomb above{0.15, 100.0, k, 2e-4};
  for (const auto& [p, without, with_threshold] :
       std::vector<std::array<double, 3>>{{0, 0, 0},
                                          {50, 8, 0},
                                          {200, 38, 17},
                                          {500, 125, 92},
                                          {1000, 300, 297},
                                          {2500, 300, 300}}) {
    EXPECT_NEAR(law.slip_limit({p, k}).shear, without, 1e-12 * k) << p;
    EXPECT_NEAR(above.slip_limit({p, k}).shear, with_threshold, 1e-12 * k) << p;
  }
}

TEST(Coulomb, CarriesNothingBelowItsThresholdPressure) {
  const Coulomb law{0.15, 100.0};
  for (const double p : {0.0, 1.0, 99.9, 100.0}) {
    EXPECT_EQ(law.slip_limit({p, k}).shear, 0.0) << p;
    EXPECT_EQ(law.slip_limit({p, k}).d_pressure, 0.0) << p;
  }
  EXPECT_GT(law.slip_limit({100.1, k}).shear, 0.0);
}

TEST(Coulomb, IsCappedByAStressOrByTheShearYieldStress) {
  EXPECT_EQ((Coulomb{0.5, 0.0, 200.0}.slip_limit({1000.0, k}).shear), 200.0);
  EXPECT_EQ((Coulomb{0.5, 0.0, 200.0}.slip_limit({1000.0, k}).d_pressure), 0.0);
  const Coulomb at_yield{0.5, 0.0, FollowedStress::yield};
  EXPECT_EQ(at_yield.slip_limit({1000.0, k}).shear, k);
  EXPECT_EQ(at_yield.slip_limit({1000.0, 250.0}).shear, 250.0) << "the cap follows the material";
}

TEST(Coulomb, GivesItsSlopeExactlyOnEveryBranch) {
  const std::array pressures{1.0, 50.0, 150.0, 390.0, 410.0, 3000.0};
  expect_exact_slope(Coulomb{0.0}, pressures, k);
  expect_exact_slope(Coulomb{0.3}, pressures, k);
  expect_exact_slope(Coulomb{0.3, 100.0}, pressures, k);
  expect_exact_slope(Coulomb{0.5, 0.0, 200.0}, pressures, k);
  expect_exact_slope(Coulomb{0.5, 100.0, FollowedStress::yield}, pressures, 60.0);
  expect_exact_slope(Coulomb{0.15, 100.0, k, 2e-4}, pressures, k);
}

TEST(Coulomb, NeverFallsWithThePressure) {
  expect_monotone_limit(Coulomb{0.3}, k);
  expect_monotone_limit(Coulomb{10.0, 50.0, 700.0}, k);
  expect_monotone_limit(Coulomb{0.5, 100.0, FollowedStress::yield}, k);
  expect_monotone_limit(Coulomb{0.15, 100.0, k, 2e-4}, k);
}

TEST(Coulomb, IsFrictionlessWithoutACoefficient) {
  EXPECT_EQ(Coulomb{0.0}.slip_limit({1e6, k}).shear, 0.0);
  EXPECT_EQ(Coulomb{0.0}.slip_limit({0.0, k}).shear, 0.0);
}

} // namespace
} // namespace billet::contact::coulomb_test
