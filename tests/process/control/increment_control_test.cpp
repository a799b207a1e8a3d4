#include "process/control/increment_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace billet::process::increment_control_test {
namespace {

constexpr IncrementControl::Limits limits{0.01, 1e-7, 1.0};

/// Whole increments through a span of time; `iterations(step)` or a failure (< 0) for each.
template <class Iterations> int increments(double span, const Iterations& iterations) {
  IncrementControl control(limits);
  int count = 0;
  for (double time = 0.0; time < span && count < 100000; ++count) {
    const double step = control.next();
    const int taken = iterations(step);
    if (taken < 0) {
      control.failed(step);
      EXPECT_FALSE(control.exhausted());
    } else {
      control.accepted(step, taken);
      time += step;
    }
  }
  return count;
}

TEST(IncrementControl, EasyIncrementsGrowToTheLongest) {
  IncrementControl control(limits);
  double before = control.next();
  for (int i = 0; i < 12; ++i) {
    control.accepted(before, 3);
    EXPECT_DOUBLE_EQ(std::min(1.5 * before, limits.max), control.next());
    before = control.next();
  }
  EXPECT_EQ(limits.max, control.next());
}

TEST(IncrementControl, AStepShortenedForALandingDoesNotShortenTheNext) {
  IncrementControl control(limits);
  control.accepted(0.001, 3);
  EXPECT_GT(control.next(), limits.first);
  IncrementControl laboured(limits);
  laboured.accepted(0.001, 7);
  EXPECT_DOUBLE_EQ(limits.first, laboured.next());
}

TEST(IncrementControl, IncrementsWhoseWorkIsKnownPoorlyAreShortenedButNotForEver) {
  // What trapezoids miss goes with the square of the length: 2 % are missed at 0.4.
  IncrementControl control(limits);
  for (int i = 0; i < 40; ++i) {
    const double step = control.next();
    control.accepted(step, 3, 0.02 * (step / 0.4) * (step / 0.4));
    EXPECT_LE(control.next(), 1.5 * 0.4);
  }
  EXPECT_GE(control.next(), 0.4);
  IncrementControl hopeless(limits);
  for (int i = 0; i < 40; ++i)
    hopeless.accepted(hopeless.next(), 3, 1.0);
  EXPECT_DOUBLE_EQ(hopeless.next(), 0.25 * limits.max);
}

TEST(IncrementControl, APoorlyKnownIncrementShortensThoseAfterItToo) {
  // Every third one is rough: the easy ones between must not bring it back to its length.
  IncrementControl control(limits);
  while (control.next() < limits.max)
    control.accepted(control.next(), 3);
  control.accepted(control.next(), 3, 0.04);
  const double shorter = control.next();
  EXPECT_NEAR(shorter, limits.max * std::sqrt(0.5), 1e-12);
  for (const double bound : {1.1, 1.21}) { // 1.5 without
    control.accepted(control.next(), 3);
    EXPECT_NEAR(control.next(), bound * shorter, 1e-12);
  }
  for (int i = 0; i < 20; ++i)
    control.accepted(control.next(), 3);
  EXPECT_DOUBLE_EQ(control.next(), limits.max) << "not for ever";
}

TEST(IncrementControl, IterationsThatDoNotDependOnTheLengthDoNotHoldItShort) {
  for (const int iterations : {7, 9, 12, 20}) {
    IncrementControl control(limits);
    for (int i = 0; i < 60; ++i)
      control.accepted(control.next(), iterations);
    EXPECT_GT(control.next(), (iterations > 9 ? 0.5 : 0.1) * limits.max)
        << iterations << " iterations";
  }
}

TEST(IncrementControl, ShortensWhereThatSavesIterations) {
  // Iterations grow with the square of the length: 10 of them at 0.003.
  const auto iterations = [](double step) {
    return static_cast<int>(3.0 + 7.0 * std::pow(step / 0.003, 2));
  };
  IncrementControl control(limits);
  double longest = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double step = control.next();
    if (constexpr int most = 24; iterations(step) > most) { // as Newton's method gives up
      control.failed(step);
      continue;
    }
    control.accepted(step, iterations(step));
    if (i > 15)
      longest = std::max(longest, step);
  }
  EXPECT_LT(longest, 0.006); // the cost is least at 0.002
  EXPECT_GT(longest, 0.001);
}

TEST(IncrementControl, FailuresAreNotAskedForAgainAtOnce) {
  // Whatever is longer than 0.05 fails: a try in a few is wasted, not every other one.
  int failures = 0;
  const int tries = increments(5.0, [&](double step) {
    failures += step > 0.05 ? 1 : 0;
    return step > 0.05 ? -1 : 4;
  });
  EXPECT_LT(failures, tries / 3) << failures << " of " << tries;
}

TEST(IncrementControl, EndsAtTheShortest) {
  IncrementControl control(limits);
  int tries = 0;
  while (!control.exhausted() && tries < 100) {
    control.failed(control.next());
    ++tries;
  }
  EXPECT_EQ(17, tries); // 0.01 / 2^17 < 1e-7
}

TEST(IncrementControl, PartsOfAnIncrementLeaveTheLengthOfTheNextAsItWas) {
  IncrementControl whole(limits), parts(limits);
  whole.accepted(limits.first, 3);
  parts.split(limits.first, 0.3, 3);
  ASSERT_TRUE(parts.in_parts());
  EXPECT_DOUBLE_EQ(parts.next(), 0.3 * limits.first);
  parts.accepted(parts.next(), 12);
  EXPECT_DOUBLE_EQ(parts.next(), 0.7 * limits.first);
  parts.split(parts.next(), 0.5, 9); // again
  EXPECT_DOUBLE_EQ(parts.next(), 0.35 * limits.first);
  parts.accepted(parts.next(), 5);
  EXPECT_DOUBLE_EQ(parts.next(), 0.35 * limits.first);
  parts.accepted(parts.next(), 1);
  EXPECT_FALSE(parts.in_parts());
  EXPECT_EQ(parts.next(), whole.next());
}

TEST(IncrementControl, AfterManyShortOnesTriesALongOne) {
  constexpr double small = 1e-3;
  constexpr int laboured = 9;
  IncrementControl control({small, 1e-6, 1.0});
  const auto accept = [&](int times) {
    for (int i = 0; i < times; ++i)
      control.accepted(small, laboured);
  };
  accept(39);
  const double before = control.next();
  EXPECT_LT(before, 2.0 * small);
  accept(1);
  EXPECT_DOUBLE_EQ(control.next(), 8.0 * small);
  control.failed(8.0 * small);
  EXPECT_DOUBLE_EQ(control.next(), before) << "as it was";
  accept(79);
  EXPECT_LT(control.next(), 2.0 * small) << "twice as patient";
  accept(1);
  EXPECT_DOUBLE_EQ(control.next(), 8.0 * small);
  control.accepted(8.0 * small, laboured);
  EXPECT_GE(control.next(), 8.0 * small);
}

TEST(IncrementControl, APartThatFailsIsNoTrial) {
  constexpr double small = 1e-3;
  IncrementControl control({small, 1e-6, 1.0});
  for (int i = 0; i < 39; ++i)
    control.accepted(small, 9);
  control.split(small, 0.5, 9); // the fortieth: a trial comes after its parts
  control.failed(control.next());
  EXPECT_LT(control.next(), small) << "cut back, not as long as before";
}

TEST(IncrementControl, APartThatFailsIsCutBackLikeAnyIncrement) {
  IncrementControl control(limits);
  control.split(limits.first, 0.4, 3);
  control.failed(control.next());
  EXPECT_FALSE(control.in_parts());
  EXPECT_DOUBLE_EQ(control.next(), 0.2 * limits.first);
  control.split(limits.first, 0.4, 3);
  control.set_next(0.5);
  EXPECT_FALSE(control.in_parts());
  EXPECT_EQ(control.next(), 0.5);
}

TEST(IncrementControl, APartEndsAtTheLandingThatItsIncrementHad) {
  EXPECT_EQ(part_towards(1.0, 0.7), 0.7) << "no two halves for the sake of the landing";
  EXPECT_EQ(part_towards(0.7, 0.7 - 1e-12), 0.7);
  EXPECT_EQ(part_towards(0.7, 0.7 + 1e-12), 0.7);
}

} // namespace
} // namespace billet::process::increment_control_test
