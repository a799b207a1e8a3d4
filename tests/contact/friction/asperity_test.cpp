#include "contact/friction/asperity.h"
#include "contact/friction/tresca.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace billet::contact::asperity_test {
namespace {

constexpr double k = 300.0; // FRI-02: shear yield of the spot values [MPa]

TEST(Asperity, HasTheSpotValuesOfThePaper) {
  // VALIDATION FRI-02, fri02_paper_law_spots.csv: eq 8 with alpha = min(1, p / 3 sigma_0).
  const Asperity asperity{0.6, k, 0.0, Flattening::bowden_tabor};
  for (const auto& [p, shear] :
       {std::array{0.0, 0.0}, std::array{50.0, 5.7735027}, std::array{500.0, 57.735027},
        std::array{1500.0, 173.20508}, std::array{2500.0, 180.0}})
    EXPECT_NEAR(asperity.slip_limit({p, 1.0}).shear, shear, 1e-5) << p; // printed to 8 digits
}

TEST(Asperity, IsCoulombAtLowAndTrescaAtHighPressure) {
  // FRI-08: tau = mu p below the limit of proportionality, tau -> m k far above it.
  const Asperity law{0.5, k, 0.5};
  const double mu = law.slip_limit({1.0, k}).shear;
  EXPECT_NEAR(law.slip_limit({500.0, k}).shear, 500.0 * mu, 1e-10 * k);
  EXPECT_NEAR(law.slip_limit({2e4, k}).shear, Tresca(0.5, k).slip_limit({2e4, k}).shear, 1e-6 * k);
  EXPECT_NEAR(mu, 0.19313597 / std::sqrt(3.0), 1e-8) << "fri02c at p = sigma_0";
}

TEST(Asperity, FollowsTheMaterialBeneathUnlessGivenAStress) {
  const Asperity follows{0.6, {}, 0.3};
  EXPECT_TRUE(follows_material(follows.k));
  EXPECT_FALSE(follows_material((Asperity{0.6, k, 0.3}).k));
  EXPECT_EQ(follows.slip_limit({400.0, k}).shear,
            (Asperity{0.6, k, 0.3}.slip_limit({400.0, 1.0}).shear));
  EXPECT_EQ(follows.slip_limit({400.0, 0.0}).shear, 0.0) << "no NaN where there is no shear_yield";
}

TEST(Asperity, GivesItsSlopesExactly) {
  const std::array pressures{1.0, 50.0, 390.0, 700.0, 1200.0, 3000.0};
  for (const double f : {0.0, 0.4, 1.0}) {
    expect_exact_slope(Asperity{0.6, {}, f}, pressures, k);
    expect_exact_slope(Asperity{0.6, 250.0, f}, pressures, k);
    expect_exact_slope(Asperity{0.6, {}, f, Flattening::bowden_tabor}, pressures, k);
    expect_monotone_limit(Asperity{0.6, {}, f}, k);
  }
}

} // namespace
} // namespace billet::contact::asperity_test
