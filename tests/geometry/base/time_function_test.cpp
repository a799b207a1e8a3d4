#include "geometry/base/time_function.h"

#include <gtest/gtest.h>

namespace billet::time_function_test {
namespace {

const TimeFunction ramp({{1.0, 2.0}, {3.0, 6.0}, {4.0, 0.0}});

TEST(TimeFunction, is_linear_between_points_and_constant_outside) {
  EXPECT_EQ(ramp(-5.0), 2.0);
  EXPECT_EQ(ramp(1.0), 2.0);
  EXPECT_DOUBLE_EQ(ramp(1.5), 3.0);
  EXPECT_EQ(ramp(3.0), 6.0);
  EXPECT_DOUBLE_EQ(ramp(3.25), 4.5);
  EXPECT_EQ(ramp(4.0), 0.0);
  EXPECT_EQ(ramp(99.0), 0.0);
}

TEST(TimeFunction, is_made_of_a_number) {
  const TimeFunction constant = 7.0;
  EXPECT_EQ(constant(-1.0), 7.0);
  EXPECT_EQ(constant(1e9), 7.0);
  EXPECT_DOUBLE_EQ(constant.integral(3.0), 21.0);
  EXPECT_EQ(TimeFunction()(2.0), 0.0);
}

TEST(TimeFunction, integral_counts_from_0_and_covers_breakpoints) {
  EXPECT_EQ(ramp.integral(0.0), 0.0);
  EXPECT_DOUBLE_EQ(ramp.integral(1.0), 2.0);
  EXPECT_DOUBLE_EQ(ramp.integral(1.5), 2.0 + 1.25);
  EXPECT_DOUBLE_EQ(ramp.integral(3.0), 2.0 + 8.0);
  EXPECT_DOUBLE_EQ(ramp.integral(4.0), 2.0 + 8.0 + 3.0);
  EXPECT_DOUBLE_EQ(ramp.integral(10.0), 13.0);
}

TEST(TimeFunction, integral_before_time_0_is_negative) {
  EXPECT_DOUBLE_EQ(TimeFunction(3.0).integral(-2.0), -6.0);
}

// Points before time 0 shape the function but not what is summed from 0 on.
TEST(TimeFunction, integral_starts_at_0_also_when_points_lie_before) {
  const TimeFunction early({{-1.0, 0.0}, {1.0, 2.0}});
  EXPECT_DOUBLE_EQ(early.integral(1.0), 1.5);
  EXPECT_DOUBLE_EQ(early.integral(2.0), 3.5);
}

} // namespace
} // namespace billet::time_function_test
