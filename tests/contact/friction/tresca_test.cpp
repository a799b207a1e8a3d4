#include "contact/friction/tresca.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>

namespace billet::contact::tresca_test {
namespace {

TEST(Tresca, HasTheSpotValueOfThePaper) {
  // VALIDATION FRI-02: m = .12, k = 300: 36.
  EXPECT_DOUBLE_EQ((Tresca{0.12, 300.0}.slip_limit({1000.0, 1.0}).shear), 36.0);
}

TEST(Tresca, FollowsTheMaterialBeneathUnlessGivenAStress) {
  EXPECT_DOUBLE_EQ((Tresca{0.5, {}}.slip_limit({10.0, 400.0}).shear), 200.0);
  EXPECT_DOUBLE_EQ((Tresca{0.5, {}}.slip_limit({10.0, 480.0}).shear), 240.0);
  EXPECT_DOUBLE_EQ((Tresca{0.5, 100.0}.slip_limit({10.0, 480.0}).shear), 50.0);
}

TEST(Tresca, DoesNotDependOnThePressure) {
  const std::array pressures{1.0, 10.0, 1000.0};
  expect_exact_slope(Tresca{0.3, 200.0}, pressures, 1.0);
  expect_monotone_limit(Tresca{0.3, {}}, 300.0);
  EXPECT_EQ((Tresca{0.3, 200.0}.slip_limit({1.0, 0.0}).shear),
            (Tresca{0.3, 200.0}.slip_limit({5000.0, 0.0}).shear));
}

TEST(Tresca, RunsFromNoneToTheWholeShearYieldStress) {
  EXPECT_EQ((Tresca{0.0, {}}.slip_limit({10.0, 400.0}).shear), 0.0);
  EXPECT_EQ((Tresca{1.0, {}}.slip_limit({10.0, 400.0}).shear), 400.0);
}

} // namespace
} // namespace billet::contact::tresca_test
