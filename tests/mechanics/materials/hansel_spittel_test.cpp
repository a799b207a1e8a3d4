#include "mechanics/materials/hansel_spittel.h"
#include "tests/support/figures.h"
#include "tests/support/flow_law_checks.h"

#include <array>

namespace billet::mechanics::hansel_spittel_test {
namespace {

constexpr HanselSpittel steel{1500.0, -0.0025, -0.12, 0.14, -0.05, 0.0, 0.0, 0.0, 0.0, 0.01};
/// Every constant in use.
constexpr HanselSpittel full{1500.0, -0.003, 0.3, 0.05, -0.002, -0.001, -0.1, 1e-4, 0.05, 0.01};

TEST(HanselSpittel, has_exact_slopes) {
  for (const HanselSpittel& law : {steel, full})
    support::check_slopes(law, {{0.02, 1e-4, 900}, {0.2, 1.0, 1000}, {2.0, 1e4, 1200}});
}

// mat07_flow_stress_spots.csv.
TEST(HanselSpittel, MAT_07_has_the_stresses_of_the_table) {
  struct Row {
    double strain, rate, celsius, stress;
  };
  constexpr std::array rows{Row{0.05, 1, 1150, 44.598858}, Row{0.1, 1, 1150, 67.662398},
                            Row{0.5, 1, 1150, 83.212539},  Row{0.5, 10, 1150, 114.86528},
                            Row{0.5, 10, 950, 189.38083},  Row{1, 50, 1200, 122.84257}};
  constexpr double tolerance = 1e-6; // VALIDATION
  for (const Row& row : rows) {
    const double stress = steel.flow_stress({row.strain, row.rate, row.celsius}).stress;
    support::show(
        "MAT-07",
        fmt::format("Hansel-Spittel at {}, {} /s, {} degC", row.strain, row.rate, row.celsius),
        stress, row.stress);
    EXPECT_NEAR(stress, row.stress, tolerance * row.stress);
  }
}

TEST(HanselSpittel, has_each_factor_of_its_formula) {
  const double eps = 0.3, rate = 7.0, T = 1000.0;
  const double by_hand = 1500.0 * std::exp(-0.003 * T) * std::pow(T, 0.05) * std::pow(eps, 0.3) *
                         std::exp(-0.002 / eps) * std::pow(1.0 + eps, -0.001 * T) *
                         std::exp(-0.1 * eps) * std::pow(rate, 0.05) * std::pow(rate, 1e-4 * T);
  EXPECT_NEAR(full.flow_stress({eps, rate, T}).stress, by_hand, 1e-13 * by_hand);
}

TEST(HanselSpittel, counts_strains_below_the_floor_as_the_floor) {
  const RateFlowStress start = steel.flow_stress({0.0, 2.0, 1000.0});
  EXPECT_EQ(start.stress, steel.flow_stress({0.01, 2.0, 1000.0}).stress);
  EXPECT_EQ(start.slope, 0.0);
}

TEST(HanselSpittel, counts_strains_above_the_ceiling_as_the_ceiling) {
  HanselSpittel ending = full;
  ending.eps_max = 0.8;
  const RateFlowStress end = ending.flow_stress({0.8, 2.0, 1000.0});
  EXPECT_EQ(end.stress, full.flow_stress({0.8, 2.0, 1000.0}).stress);
  const RateFlowStress beyond = ending.flow_stress({5.0, 2.0, 1000.0});
  EXPECT_EQ(beyond.stress, end.stress);
  EXPECT_EQ(beyond.slope, 0.0);
  EXPECT_EQ(beyond.rate_slope, end.rate_slope);
  // Not to the bit: of one the compiler may know the numbers, and fuse other operations.
  EXPECT_DOUBLE_EQ(ending.flow_stress({0.79, 2.0, 1000.0}).slope,
                   full.flow_stress({0.79, 2.0, 1000.0}).slope);
  EXPECT_LT(full.flow_stress({5.0, 2.0, 1000.0}).stress, 0.5 * end.stress) << "without one";
  support::check_slopes(ending, {{0.02, 1e-4, 900}, {0.5, 1.0, 1000}, {2.0, 1e4, 1200}});
  support::check_everywhere(ending, {20.0, 900.0, 1500.0});
}

TEST(HanselSpittel, is_sound_everywhere) {
  support::check_everywhere(steel, {20.0, 900.0, 1500.0});
  support::check_everywhere(full, {20.0, 900.0, 1500.0});
  EXPECT_EQ(steel.flow_stress({0.3, 0.0, 1000.0}).stress, 0.0);
  HanselSpittel plain = steel; // without any rate
  plain.m3 = 0.0;
  EXPECT_EQ(plain.flow_stress({0.3, 0.0, 900.0}).stress,
            plain.flow_stress({0.3, 1e9, 900.0}).stress);
  EXPECT_EQ(plain.flow_stress({0.3, 0.0, 900.0}).rate_slope, 0.0);
  plain.m8 = -1e-4; // would fall with the rate
  EXPECT_EQ(plain.sensitivity(900.0), 0.0);
}

} // namespace
} // namespace billet::mechanics::hansel_spittel_test
