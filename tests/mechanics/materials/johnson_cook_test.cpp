#include "mechanics/materials/johnson_cook.h"
#include "tests/support/figures.h"
#include "tests/support/flow_law_checks.h"

#include <array>

namespace billet::mechanics::johnson_cook_test {
namespace {

constexpr double zero_celsius = 273.15;
/// AISI 4340, Johnson and Cook (1983).
constexpr JohnsonCook steel{
    792.0, 510.0, 0.26, 0.014, 1.0, 1.03, 293.0 - zero_celsius, 1793.0 - zero_celsius};

TEST(JohnsonCook, has_exact_slopes) {
  support::check_slopes(steel, {{0.01, 1e-3, 20}, {0.2, 10.0, 400}, {2.0, 1e4, 1200}});
}

// mat07_flow_stress_spots.csv, temperatures there in K.
TEST(JohnsonCook, MAT_07_has_the_stresses_of_the_table) {
  struct Row {
    double strain, rate, kelvin, stress;
  };
  constexpr std::array rows{Row{0.05, 1, 293, 1026.0466},  Row{0.5, 1, 293, 1217.8948},
                            Row{0.5, 100, 293, 1296.4154}, Row{0.5, 1000, 673, 1010.9594},
                            Row{1, 10, 1000, 724.6473},    Row{0.2, 1, 1793, 0.0}};
  constexpr double tolerance = 1e-6; // VALIDATION; where the table says 0 the law keeps its floor
  for (const Row& row : rows) {
    const double T = row.kelvin - zero_celsius;
    const double stress = steel.flow_stress({row.strain, row.rate, T}).stress;
    support::show("MAT-07",
                  fmt::format("Johnson-Cook at {}, {} /s, {} K", row.strain, row.rate, row.kelvin),
                  stress, row.stress);
    const double scale = row.stress > 0.0
                             ? row.stress
                             : steel.flow_stress({row.strain, row.rate, steel.T_room}).stress;
    EXPECT_NEAR(stress, row.stress, tolerance * scale * (1.0 + 1e-9));
  }
}

TEST(JohnsonCook, counts_slow_and_cold_as_its_references) {
  const double at_reference = steel.flow_stress({0.3, 1.0, steel.T_room}).stress;
  EXPECT_EQ(steel.flow_stress({0.3, 0.0, steel.T_room}).stress, at_reference);
  EXPECT_EQ(steel.flow_stress({0.3, 0.5, -100.0}).stress, at_reference);
  EXPECT_EQ(steel.flow_stress({0.3, 0.5, steel.T_room}).rate_slope, 0.0);
}

TEST(JohnsonCook, is_sound_everywhere_and_keeps_a_millionth_of_its_flow_stress_when_molten) {
  support::check_everywhere(steel, {-273.0, 20.0, 1519.0, 1520.0, 1e6});
  JohnsonCook plain = steel;
  plain.n = 0.0;
  support::check_everywhere(plain, {20.0});
  plain = steel;
  plain.B = 0.0;
  support::check_everywhere(plain, {20.0});
  EXPECT_DOUBLE_EQ(steel.flow_stress({0.3, 1.0, 2000.0}).stress,
                   JohnsonCook::melt_floor * steel.flow_stress({0.3, 1.0, 0.0}).stress);
}

} // namespace
} // namespace billet::mechanics::johnson_cook_test
