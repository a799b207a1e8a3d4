#include "contact/tools/ram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace billet::contact::ram_test {
namespace {

constexpr double mass = 2.0;    // [N s^2/mm]
constexpr double spring = 50.0; // [N/mm]

/// A ram against a spring: solves the increment's equation, linear here, and takes it in.
double advance(Ram& ram, double& place, double dt) {
  // inertia(way) + spring (place + way) = 0
  const double way = -(ram.inertia(0.0, dt) + spring * place) / (ram.stiffness(dt) + spring);
  ram.speed = ram.speed_after(way, dt);
  place += way;
  const double work = 0.5 * way * (ram.force - spring * place);
  ram.force = -spring * place;
  return work;
}

TEST(Ram, loses_exactly_the_energy_that_its_work_takes) {
  for (const double dt : {1e-3, 0.1, 2.0}) { // of a period of 1.26 s
    Ram ram{mass, 3.0, 0.0};
    double place = 0.0, work = 0.0;
    const double given = ram.energy();
    for (int k = 0; k < 100; ++k)
      work += advance(ram, place, dt);
    EXPECT_NEAR(ram.energy(), given + work, 1e-12 * given) << dt;
    EXPECT_NEAR(ram.energy() + 0.5 * spring * place * place, given, 1e-12 * given) << dt;
  }
}

TEST(Ram, stops_after_a_quarter_of_a_period_to_the_second_order) {
  const double quarter = 0.5 * std::numbers::pi * std::sqrt(mass / spring);
  double last = 0.0;
  for (const int n : {20, 40, 80}) {
    Ram ram{mass, 3.0, 0.0};
    double place = 0.0;
    for (int k = 0; k < n; ++k)
      (void)advance(ram, place, quarter / n);
    const double error = std::abs(ram.speed);
    std::printf("[RAM] %d increments: speed %.2e of 3 mm/s left\n", n, error);
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 4.0, 0.1);
    }
    last = error;
  }
}

TEST(Ram, has_a_stiffness_that_is_the_slope_of_its_inertia) {
  const Ram ram{mass, 3.0, -7.0};
  EXPECT_NEAR(ram.inertia(0.5, 0.1) - ram.inertia(0.2, 0.1), 0.3 * ram.stiffness(0.1), 1e-9);
}

} // namespace
} // namespace billet::contact::ram_test
