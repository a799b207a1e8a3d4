// What an increment begins with.

#include "process/first_guess.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace billet::process::first_guess_test {
namespace {

using Path = std::function<std::vector<double>(double)>;

std::vector<double> parabola(double t) { return {t + 0.05 * t * t, 1.0 - 2.0 * t, 0.1 * t * t}; }

/// Goes by a path whose increments end at these times; the guess at the last of them.
std::vector<double> guess(const Path& at, const std::vector<double>& times, bool fails = false) {
  FirstGuess first;
  for (std::size_t k = 1; k + 1 < times.size(); ++k)
    first.note(at(times[k - 1]), at(times[k]), times[k] - times[k - 1]);
  if (fails)
    first.straighten();
  std::vector<double> x = at(times[times.size() - 2]);
  first.go_on(times.back() - times[times.size() - 2], x);
  return x;
}

void expect_at(const std::vector<double>& x, const std::vector<double>& expected) {
  constexpr double rounding = 1e-13;
  ASSERT_EQ(x.size(), expected.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(x[i], expected[i], rounding) << i;
}

TEST(FirstGuess, GoesOnWithASteadyChangeOfVelocityInIncrementsOfAnyLength) {
  expect_at(guess(parabola, {0.0, 0.1, 0.2, 0.3, 0.4}), parabola(0.4));
  expect_at(guess(parabola, {0.0, 0.1, 0.25, 0.3, 0.42}), parabola(0.42));
}

TEST(FirstGuess, GoesStraightOnUntilTwoIncrementsHaveGoneOnStraight) {
  // After two increments only one of them can be compared with the one before.
  expect_at(guess(parabola, {0.0, 0.1, 0.2, 0.3}),
            {0.3 + 0.05 * (0.04 + 0.03), 0.4, 0.1 * (0.04 + 0.03)});
}

TEST(FirstGuess, GoesStraightOnAfterATurn) {
  const Path turns = [](double t) { return std::vector<double>{t, t < 0.3 ? 0.0 : t - 0.3}; };
  expect_at(guess(turns, {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}), {0.5, 0.2});
  expect_at(guess(turns, {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}), {0.6, 0.3});
}

TEST(FirstGuess, GoesStraightOnAfterARefusalAndFarBeyondShortIncrements) {
  const double slope = (parabola(0.3)[2] - parabola(0.2)[2]) / 0.1;
  EXPECT_NEAR(guess(parabola, {0.0, 0.1, 0.2, 0.3, 0.4}, true)[2], parabola(0.3)[2] + 0.1 * slope,
              1e-13);
  const double short_slope = (parabola(0.3)[2] - parabola(0.299)[2]) / 0.001;
  EXPECT_NEAR(guess(parabola, {0.297, 0.298, 0.299, 0.3, 0.4})[2],
              parabola(0.3)[2] + 0.1 * short_slope, 1e-12);
}

TEST(FirstGuess, KnowsNothingBeforeTheFirstIncrementAndOnANewMeshWhatItIsGiven) {
  FirstGuess first;
  EXPECT_FALSE(first.known());
  first.note(std::vector<double>{0.0}, std::vector<double>{1.0}, 0.5);
  EXPECT_TRUE(first.known());
  first.forget();
  EXPECT_FALSE(first.known());
  first.begin_with({2.0, 4.0}, 0.5);
  std::vector<double> x{1.0, 1.0};
  first.go_on(0.25, x);
  EXPECT_EQ(x, (std::vector<double>{2.0, 3.0}));
  // The first increment there is not compared with what the mesh before did.
  first.note(std::vector<double>{1.0, 1.0}, std::vector<double>{2.0, 3.0}, 0.25);
  first.go_on(0.25, x);
  EXPECT_EQ(x, (std::vector<double>{3.0, 5.0}));
}

} // namespace
} // namespace billet::process::first_guess_test
