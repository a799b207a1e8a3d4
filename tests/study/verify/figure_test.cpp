// When a figure is within its tolerance.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/verify/figure.h"

namespace billet::study::figure_test {
namespace {

TEST(Figure, relative_tolerances_are_shares_of_the_reference) {
  EXPECT_TRUE(within_tolerance(relative("f", "N", 101.0, 100.0, 0.011)));
  EXPECT_FALSE(within_tolerance(relative("f", "N", 102.0, 100.0, 0.011)));
  EXPECT_FALSE(within_tolerance(relative("f", "N", -98.0, -100.0, 0.011)));
  EXPECT_NEAR(deviation(relative("f", "N", -98.0, -100.0, 0.01)), 0.02, 1e-15);
}

TEST(Figure, absolute_tolerances_have_the_unit_of_the_figure) {
  EXPECT_TRUE(within_tolerance(absolute("f", "mm", 1e-10, 0.0, 1e-9)));
  EXPECT_FALSE(within_tolerance(absolute("f", "mm", -2e-9, 0.0, 1e-9)));
  EXPECT_TRUE(within_tolerance(absolute("f", "mm", 3.0, 3.0, 0.0)));
}

TEST(Figure, bounds_hold_on_one_side_only) {
  EXPECT_TRUE(within_tolerance(at_most("f", "-", 0.5, 1.0, 0.0)));
  EXPECT_FALSE(within_tolerance(at_most("f", "-", 1.1, 1.0, 0.05)));
  EXPECT_TRUE(within_tolerance(at_least("f", "-", 2.0, 1.0, 0.0)));
  EXPECT_FALSE(within_tolerance(at_least("f", "-", 0.9, 1.0, 0.05)));
}

TEST(Figure, what_is_not_a_number_or_has_no_reference_fails) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto make : {&relative, &absolute, &at_most, &at_least}) {
    EXPECT_FALSE(within_tolerance(make("f", "-", nan, 1.0, 1.0)));
    EXPECT_FALSE(within_tolerance(make("f", "-", 1.0, nan, 1.0)));
  }
  EXPECT_FALSE(within_tolerance(relative("f", "-", 1e-30, 0.0, 0.1)));
  EXPECT_TRUE(within_tolerance(relative("f", "-", 0.0, 0.0, 0.1)));
}

} // namespace
} // namespace billet::study::figure_test
