#include "mechanics/materials/norton_hoff.h"
#include "tests/support/figures.h"
#include "tests/support/flow_law_checks.h"

#include <array>

namespace billet::mechanics::norton_hoff_test {
namespace {

TEST(NortonHoff, has_exact_slopes) {
  for (const double yield : {0.0, 80.0}) {
    const NortonHoff law{50.0, 0.2, 0.15, 0.01, yield};
    support::check_slopes(law, {{0.01, 1e-6, 900}, {0.2, 1.0, 900}, {2.0, 1e4, 900}});
  }
  support::check_slopes(NortonHoff{50.0, 1.0, 0.0, 0.0, 0.0}, {{0.2, 1.0, 20}});
}

// Columns Norton and NortonHoff of mat06_rate_dependence.csv.
TEST(NortonHoff, MAT_06_has_the_stresses_of_the_table) {
  struct Row {
    double rate, norton, norton_hoff;
  };
  constexpr std::array rows{Row{1e-4, 25.118864, 15.319435}, Row{1e-2, 50.118723, 38.480682},
                            Row{1.0, 100.0, 96.659102}, Row{10.0, 141.25375, 153.19435},
                            Row{100.0, 199.52623, 242.79669}};
  constexpr double digits = 1e-7; // of the table
  // sqrt(3) K (sqrt(3) rate)^m = 100 rate^0.15
  const NortonHoff norton{100.0 / std::pow(std::numbers::sqrt3, 1.15), 0.15, 0.0, 0.0, 0.0};
  const NortonHoff hoff{50.0, 0.2, 0.0, 0.0, 0.0};
  for (const Row& row : rows) {
    const double a = norton.flow_stress({0.3, row.rate, 20.0}).stress;
    const double b = hoff.flow_stress({0.3, row.rate, 20.0}).stress;
    support::show("MAT-06", fmt::format("Norton at {} /s", row.rate), a, row.norton);
    support::show("MAT-06", fmt::format("Norton-Hoff at {} /s", row.rate), b, row.norton_hoff);
    EXPECT_NEAR(a, row.norton, digits * row.norton);
    EXPECT_NEAR(b, row.norton_hoff, digits * row.norton_hoff);
  }
}

TEST(NortonHoff, is_sound_at_rest_at_no_strain_and_at_absurd_rates) {
  support::check_everywhere(NortonHoff{50.0, 0.2, 0.15, 0.0, 0.0}, {900.0});
  support::check_everywhere(NortonHoff{50.0, 0.2, 0.0, 0.0, 10.0}, {900.0});
  support::check_everywhere(NortonHoff{50.0, 1.0, 0.15, 0.01, 0.0}, {900.0});
  EXPECT_EQ((NortonHoff{50.0, 0.2, 0.0, 0.0, 0.0}.flow_stress({0.1, 0.0, 20.0}).stress), 0.0);
  EXPECT_EQ((NortonHoff{50.0, 0.2, 0.0, 0.0, 30.0}.flow_stress({0.1, 0.0, 20.0}).stress), 30.0);
}

} // namespace
} // namespace billet::mechanics::norton_hoff_test
