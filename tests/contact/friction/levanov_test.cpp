#include "contact/friction/coulomb.h"
#include "contact/friction/levanov.h"
#include "contact/friction/tresca.h"
#include "tests/support/contact_laws.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace billet::contact::levanov_test {
namespace {

constexpr double k = 300.0;
constexpr double sigma_y = std::numbers::sqrt3 * k;

double limit(const Levanov& law, double pressure) { return law.slip_limit({pressure, k}).shear; }

TEST(Levanov, HasItsClosedFormValues) {
  // 1 - exp(-1.25) = 0.713495 of m k where the pressure is the yield stress.
  EXPECT_NEAR(limit({0.4, {}}, sigma_y), 0.4 * k * 0.713495, 1e-6 * k);
  EXPECT_DOUBLE_EQ(limit({0.4, {}, 2.0}, 0.5 * sigma_y), 0.4 * k * (1.0 - std::exp(-1.0)));
  EXPECT_EQ(limit({0.4, {}}, 0.0), 0.0);
  EXPECT_EQ(limit({0.0, {}}, 1000.0), 0.0);
}

TEST(Levanov, IsCoulombsLawAtLowPressureAndTrescasAtHigh) {
  const Levanov law{0.4, {}};
  const double mu = 1.25 * 0.4 / std::numbers::sqrt3;
  EXPECT_NEAR(limit(law, 1e-6), Coulomb{mu}.slip_limit({1e-6, k}).shear, 1e-14);
  EXPECT_DOUBLE_EQ(law.slip_limit({0.0, k}).d_pressure, mu);
  EXPECT_DOUBLE_EQ(limit(law, 1e5), (Tresca{0.4, {}}.slip_limit({1e5, k}).shear));
}

TEST(Levanov, GivesItsSlopesExactly) {
  const std::array pressures{1.0, 50.0, 300.0, 1000.0, 5000.0};
  expect_exact_slope(Levanov{0.4, {}}, pressures, k);
  expect_exact_slope(Levanov{0.4, 250.0}, pressures, k);
  expect_exact_slope(Levanov{1.0, FollowedStress::von_mises, 3.0}, pressures, k);
  expect_monotone_limit(Levanov{0.4, {}}, k);
}

TEST(Levanov, FollowsTheMaterialBeneathUnlessGivenAStress) {
  EXPECT_EQ(limit({0.4, 250.0}, 200.0), (Levanov{0.4, {}}.slip_limit({200.0, 250.0}).shear));
  EXPECT_EQ((Levanov{0.4, 250.0}.slip_limit({200.0, k}).d_shear_yield), 0.0);
  EXPECT_GT((Levanov{0.4, {}}.slip_limit({200.0, k}).d_shear_yield), 0.0);
}

TEST(Levanov, HasItsLimitsWithoutShearYieldStressOrPressure) {
  const Levanov law{0.4, {}};
  for (const double shear_yield : {0.0, std::numeric_limits<double>::denorm_min(), 1e-300}) {
    const SlipLimit pressed = law.slip_limit({200.0, shear_yield});
    EXPECT_EQ(pressed.shear, 0.4 * shear_yield) << "the pressure saturates it at once";
    EXPECT_EQ(pressed.d_pressure, 0.0);
    EXPECT_DOUBLE_EQ(pressed.d_shear_yield, 0.4);
  }
  for (const double shear_yield : {0.0, 1e-300, k}) {
    const SlipLimit open = law.slip_limit({0.0, shear_yield});
    EXPECT_EQ(open.shear, 0.0);
    EXPECT_EQ(open.d_shear_yield, 0.0);
    EXPECT_EQ(open.d_pressure, shear_yield > 0.0 ? 0.4 * 1.25 / std::numbers::sqrt3 : 0.0);
  }
}

} // namespace
} // namespace billet::contact::levanov_test
