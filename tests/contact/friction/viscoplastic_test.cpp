#include "contact/friction/viscoplastic.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace billet::contact::viscoplastic_test {
namespace {

double at_speed(const Viscoplastic& law, double v) {
  return law.slip_limit({100.0, 300.0, v}).shear;
}

TEST(Viscoplastic, HasTheSpotValuesOfThePaper) {
  // VALIDATION fri02b: beta = 30, v0 = 10, mv = .15; FRI-03.
  const Viscoplastic law{30.0, 10.0, 0.15};
  for (const auto& [v, shear] :
       {std::array{0.0, 0.0}, std::array{0.1, 15.035617}, std::array{1.0, 21.238374},
        std::array{10.0, 30.0}, std::array{100.0, 42.376126}})
    EXPECT_NEAR(at_speed(law, v), shear, 1e-6) << v; // printed to 8 digits
  EXPECT_NEAR(at_speed(law, 1.0), 30.0 * std::pow(0.1, 0.15), 1e-12 * 30.0);
  for (const double v : {1e-3, 5.0})
    expect_exact_slope(Viscoplastic{30.0, v, 0.15}, std::array{1.0, 100.0}, 300.0);
}

TEST(Viscoplastic, StartsSmoothlyAndGrowsWithoutEnd) {
  for (const double mv : {0.05, 0.15, 0.6, 1.0}) {
    const Viscoplastic law{30.0, 10.0, mv};
    double last = 0.0;
    for (double v = 1e-9; v < 1e3; v *= 1.1) {
      EXPECT_GT(at_speed(law, v), last) << mv << ' ' << v;
      last = at_speed(law, v);
    }
    // The cubic and the power meet with value and slope.
    const double meet = 10.0 * Viscoplastic::start;
    const auto slope = [&](double v) { return law.slip_limit({1.0, 1.0, v}).d_speed; };
    EXPECT_NEAR(at_speed(law, meet * (1.0 - 1e-12)), at_speed(law, meet), 1e-9 * 30.0) << mv;
    EXPECT_NEAR(slope(meet * (1.0 - 1e-9)) / slope(meet), 1.0, 1e-6) << mv;
    EXPECT_TRUE(std::isfinite(slope(0.0))) << mv;
  }
  EXPECT_NEAR(at_speed(Viscoplastic{30.0, 10.0, 1.0}, 1e-4), 30.0 * 1e-5, 1e-15 * 30.0)
      << "linear all the way: a Newtonian film";
}

} // namespace
} // namespace billet::contact::viscoplastic_test
