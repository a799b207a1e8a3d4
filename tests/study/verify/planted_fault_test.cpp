// Faults are seen: the figures that the solver gives do not fit a law with a wrong sign or factor.
//
// Solver and law disagree in the same way whichever of the two is wrong, so the law that the
// figures are held against is spoilt here, and the product has no switch for it.

#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/verify/friction_block.h"
#include "study/verify/problems.h"
#include "study/verify/ring_bound.h"

namespace billet::study::planted_fault_test {
namespace {

const SlidingBlock second_order{"second-order",
                                R"({ law = "coulomb", mu = 0.15, threshold = 100, mu2 = 1e-4 })",
                                {{300.0, 1.0}, {600.0, 1.0}}};

std::vector<Figure> against(const ShearLaw& law) {
  const test::TemporaryFolder folder;
  return block_figures(CaseBench(folder.path()), second_order, law);
}

bool all_within(const std::vector<Figure>& figures) {
  return figures.size() == second_order.steps.size() &&
         std::all_of(figures.begin(), figures.end(), within_tolerance);
}
bool none_within(const std::vector<Figure>& figures) {
  return figures.size() == second_order.steps.size() &&
         std::none_of(figures.begin(), figures.end(), within_tolerance);
}

double law_of_second_order(const BlockStep& at, double sign_of_mu2, double sign_of_threshold) {
  const double q = at.pressure - sign_of_threshold * 100.0;
  return 0.15 * q + sign_of_mu2 * 1e-4 * q * q;
}

TEST(PlantedFault, the_law_itself_is_met) {
  EXPECT_TRUE(
      all_within(against([](const BlockStep& at) { return law_of_second_order(at, 1.0, 1.0); })));
}

TEST(PlantedFault, a_wrong_sign_of_the_shear_is_seen) {
  EXPECT_TRUE(
      none_within(against([](const BlockStep& at) { return -law_of_second_order(at, 1.0, 1.0); })));
}

TEST(PlantedFault, a_wrong_sign_of_the_second_order_is_seen) {
  EXPECT_TRUE(
      none_within(against([](const BlockStep& at) { return law_of_second_order(at, -1.0, 1.0); })));
}

TEST(PlantedFault, a_wrong_sign_of_the_threshold_is_seen) {
  EXPECT_TRUE(
      none_within(against([](const BlockStep& at) { return law_of_second_order(at, 1.0, -1.0); })));
}

TEST(RingBound, the_bound_without_friction_is_the_homogeneous_ring) {
  constexpr double exact = 100.0 * (1.0 - 1.5811388300841898); // 1 - 1 / sqrt(0.4)
  EXPECT_NEAR(bore_decrease_of_bound({4.5, 9.0, 6.0}, 0.0, 0.6), exact, 1e-3);
}

TEST(RingBound, the_field_changes_continuously_where_the_neutral_circle_enters_the_ring) {
  const RingShape ring{4.5, 9.0, 6.0};
  double last = neutral_square(ring, 0.0);
  for (double m = 0.001; m <= 1.0; m += 0.001) {
    const double c = neutral_square(ring, m);
    EXPECT_GE(c, last) << m;
    EXPECT_LT(c - last, 1.0) << m;
    last = c;
  }
  EXPECT_GT(last, 4.5 * 4.5);
  EXPECT_LT(last, 9.0 * 9.0);
}

} // namespace
} // namespace billet::study::planted_fault_test
