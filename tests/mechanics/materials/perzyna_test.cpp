#include "mechanics/materials/perzyna.h"
#include "tests/support/figures.h"
#include "tests/support/flow_law_checks.h"

#include <array>

namespace billet::mechanics::perzyna_test {
namespace {

TEST(Perzyna, has_exact_slopes_over_every_base) {
  const std::array<AnyStaticLaw, 6> bases{
      Perfect{200.0},          Linear{200.0, 300.0},
      Swift{500.0, 0.01, 0.2}, Ludwik{200.0, 300.0, 0.4},
      Voce{200.0, 400.0, 5.0}, FlowTable{{{0.0, 200.0}, {0.5, 300.0}, {1.0, 250.0}, {4.0, 200.0}}}};
  for (const AnyStaticLaw& base : bases)
    for (const double m : {0.2, 1.0, 1.7})
      support::check_slopes(Perzyna{base, 0.03, m},
                            {{0.01, 1e-3, 20}, {0.2, 1.0, 20}, {2.0, 1e4, 20}});
}

// Column Perzyna of mat06_rate_dependence.csv: sy = 200, D = 40 /s, n = 5.
TEST(Perzyna, MAT_06_has_the_stresses_of_the_table) {
  constexpr std::array<std::array<double, 2>, 5> rows{{{1e-4, 215.15717},
                                                       {1e-2, 238.07308},
                                                       {1.0, 295.63525},
                                                       {10.0, 351.57166},
                                                       {100.0, 440.22489}}};
  constexpr double digits = 1e-7; // of the table
  const Perzyna law{Perfect{200.0}, 1.0 / 40.0, 0.2};
  for (const auto& [rate, reference] : rows) {
    const double stress = law.flow_stress({0.0, rate, 20.0}).stress;
    support::show("MAT-06", fmt::format("Perzyna at {} /s", rate), stress, reference);
    EXPECT_NEAR(stress, reference, digits * reference);
  }
}

TEST(Perzyna, is_sound_everywhere_and_tends_to_its_base) {
  support::check_everywhere(Perzyna{Ludwik{200.0, 300.0, 0.4}, 1.0, 0.2}, {20.0});
  const Swift base{500.0, 0.01, 0.2};
  const double limit = base.flow_stress(0.3).stress;
  EXPECT_EQ((Perzyna{base, 1.0, 0.3}.flow_stress({0.3, 0.0, 20.0}).stress), limit);
  EXPECT_NEAR((Perzyna{base, 1e-30, 0.3}.flow_stress({0.3, 10.0, 20.0}).stress), limit, 1e-6);
}

} // namespace
} // namespace billet::mechanics::perzyna_test
