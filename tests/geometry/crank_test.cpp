#include "geometry/crank.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::geometry::crank_test {
namespace {

constexpr double pi = std::numbers::pi;

Crank press(double start, const TimeFunction& speed) {
  return {Vec3(0, -1, 0), 80.0, 480.0, start, speed};
}

TEST(Crank, moves_the_slide_as_the_triangle_of_crank_and_rod_says) {
  const Crank crank = press(0.3, 2.0);
  constexpr double rounding = 1e-12;
  for (const double t : {0.0, 0.1, 0.7, 1.5, 3.0, 10.0}) {
    // The pin at (r sin, -r cos) seen from the shaft, the slide a rod's length further on.
    const auto slide = [](double angle) {
      return -80.0 * std::cos(angle) +
             std::sqrt(480.0 * 480.0 - std::pow(80.0 * std::sin(angle), 2));
    };
    EXPECT_NEAR(crank.travel(t), slide(0.3 + 2.0 * t) - slide(0.3), rounding * 480.0) << t;
  }
}

TEST(Crank, has_a_stroke_of_twice_its_radius_and_stands_still_at_the_dead_centres) {
  const Crank crank = press(0.0, 2.0);
  EXPECT_EQ(crank.travel(0.0), 0.0);
  EXPECT_NEAR(crank.travel(0.5 * pi), 160.0, 1e-12 * 160.0);
  EXPECT_NEAR(crank.travel(pi), 0.0, 1e-12 * 160.0);
  EXPECT_EQ(crank.slide_speed(0.0), 0.0);
  EXPECT_NEAR(crank.slide_speed(0.5 * pi), 0.0, 1e-12 * 160.0);
}

TEST(Crank, has_the_speed_that_is_the_slope_of_its_way) {
  const Crank crank = press(1.0, TimeFunction({{0.0, 1.0}, {4.0, 3.0}}));
  for (const double t : {0.2, 1.0, 2.3, 3.7}) {
    constexpr double h = 1e-5;
    const double slope = (crank.travel(t + h) - crank.travel(t - h)) / (2.0 * h);
    EXPECT_NEAR(crank.slide_speed(t), slope, 1e-7 * 240.0) << t;
  }
}

TEST(Crank, knows_when_it_is_at_the_bottom) {
  const std::vector<double> times = press(0.0, 2.0).bottom_dead_centres(6.0);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 0.5 * pi, 1e-12);
  EXPECT_NEAR(times[1], 1.5 * pi, 1e-12);
  // Beyond the first one: the next is a whole turn on. At one: that one is past.
  EXPECT_NEAR(press(1.5 * pi, 2.0).bottom_dead_centres(6.0).at(0), 0.75 * pi, 1e-12);
  EXPECT_NEAR(press(pi, 2.0).bottom_dead_centres(6.0).at(0), pi, 1e-12);
  EXPECT_TRUE(press(0.0, 0.0).bottom_dead_centres(6.0).empty());
  EXPECT_EQ(press(0.0, 1e9).bottom_dead_centres(6.0).size(), 1000u);
}

} // namespace
} // namespace billet::geometry::crank_test
