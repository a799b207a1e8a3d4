#include "contact/friction/shaw.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>

namespace billet::contact::shaw_test {
namespace {

constexpr double k = 300.0; // FRI-02: shear yield of the spot values [MPa]

TEST(Shaw, HasTheSpotValuesOfThePaper) {
  // VALIDATION FRI-02, eq 6 with alpha = min(1, p / 3 sigma_0).
  const Shaw law{k, 0.0, Flattening::bowden_tabor};
  for (const auto& [p, shear] :
       {std::array{0.0, 0.0}, std::array{200.0, 38.490018}, std::array{1000.0, 192.45009},
        std::array{1500.0, 288.67513}, std::array{2500.0, 300.0}})
    EXPECT_NEAR(law.slip_limit({p, 1.0}).shear, shear, 1e-5) << p; // printed to 8 digits
}

TEST(Shaw, IsTheGlobalCoefficientOfThePaper) {
  // Eq 2: mu_G = k / H with H = 3 sigma_0 is .19245 for von Mises, whatever k.
  for (const double shear_yield : {30.0, k, 900.0}) {
    const Shaw law{{}, 0.0, Flattening::bowden_tabor};
    EXPECT_NEAR(law.slip_limit({100.0, shear_yield}).shear / 100.0, 0.19245009, 1e-8);
  }
}

TEST(Shaw, GivesItsSlopesExactly) {
  const std::array pressures{1.0, 390.0, 700.0, 1200.0, 3000.0};
  expect_exact_slope(Shaw{{}, 0.4}, pressures, k);
  expect_exact_slope(Shaw{{}, 0.0, Flattening::bowden_tabor}, pressures, k);
  expect_monotone_limit(Shaw{{}, 0.7}, k);
}

} // namespace
} // namespace billet::contact::shaw_test
