// What modifies a law: tables, evolution, the cone.

#include "contact/friction/friction.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace billet::contact::friction_test {
namespace {

TEST(CoefficientTable, IsLinearBetweenItsPointsAndConstantOutside) {
  const CoefficientTable table({{{0.0, 100.0}, {}, {}}}, {0.1, 0.3});
  EXPECT_DOUBLE_EQ(table({50.0, 7.0, 9.0}).value, 0.2);
  EXPECT_DOUBLE_EQ(table({50.0, 7.0, 9.0}).d_pressure, 0.002);
  EXPECT_DOUBLE_EQ(table({1e9, 0.0, 0.0}).value, 0.3);
  EXPECT_EQ(table({1e9, 0.0, 0.0}).d_pressure, 0.0);
  EXPECT_EQ(CoefficientTable()({1.0, 2.0, 3.0}).value, 1.0);
}

TEST(CoefficientTable, InterpolatesOnAGridWithExactSlopes) {
  const CoefficientTable table({{{0.0, 30.0, 90.0}, {0.0, 2.0}, {0.0, 1.0}}},
                               {0.1, 0.15, 0.2, 0.1, 0.3, 0.25, 0.2, 0.3, 0.4, 0.2, 0.3, 0.2});
  EXPECT_DOUBLE_EQ(table({30.0, 2.0, 1.0}).value, 0.3);
  EXPECT_DOUBLE_EQ(table({90.0, 0.0, 0.0}).value, 0.4);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> share(0.01, 0.99);
  constexpr double h = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const CoefficientPoint at{90.0 * share(generator), 2.0 * share(generator), share(generator)};
    const Coefficient c = table(at);
    const auto difference = [&](double CoefficientPoint::*member) {
      CoefficientPoint above = at;
      CoefficientPoint below = at;
      above.*member += h;
      below.*member -= h;
      return (table(above).value - table(below).value) / (2.0 * h);
    };
    if (std::abs(at.pressure - 30.0) > h) {
      EXPECT_NEAR(c.d_pressure, difference(&CoefficientPoint::pressure), 1e-9);
    }
    EXPECT_NEAR(c.d_speed, difference(&CoefficientPoint::speed), 1e-9);
    EXPECT_NEAR(c.d_sliding, difference(&CoefficientPoint::sliding), 1e-9);
  }
}

TEST(CoefficientTable, RefusesWhatDoesNotFit) {
  EXPECT_THROW(CoefficientTable({{{0.0, 1.0}, {}, {}}}, {1.0}), std::invalid_argument);
  EXPECT_THROW(CoefficientTable({{{1.0, 1.0}, {}, {}}}, {1.0, 2.0}), std::invalid_argument);
}

TEST(Friction, EvolvesWithTheSlidingDistance) {
  // Pick-up: the factor on the coefficient, at the distance slid before and in the increment.
  Friction friction = Coulomb{0.1};
  friction.evolution = {{{{}, {}, {0.0, 10.0, 20.0}}}, {1.0, 1.0, 3.0}};
  EXPECT_TRUE(friction.depends_on_slip());
  EXPECT_DOUBLE_EQ(limit_at(friction, {100.0, 0.0, 5.0, 1.0}, 0.0).shear, 10.0);
  EXPECT_DOUBLE_EQ(limit_at(friction, {100.0, 0.0, 14.0, 1.0}, 1.0).shear, 20.0);
  EXPECT_DOUBLE_EQ(limit_at(friction, {100.0, 0.0, 14.0, 1.0}, 1.0).d_slip, 2.0);
  EXPECT_DOUBLE_EQ(limit_at(friction, {100.0, 0.0, 90.0, 1.0}, 1.0).shear, 30.0);
}

TEST(Friction, HasTheDerivativesOfItsLimit) {
  const SlipState at{47.0, 110.0, 0.01, 0.5};
  constexpr double slip = 0.013;
  constexpr double h = 1e-7;
  for (const auto& [name, friction] : every_law()) {
    const LimitAtSlip limit = limit_at(friction, at, slip);
    const auto near = [&](double p, double shear_yield, double s) {
      SlipState moved = at;
      moved.pressure += p;
      moved.shear_yield += shear_yield;
      return limit_at(friction, moved, slip + s).shear;
    };
    const double scale = 1e-6 * (1.0 + limit.shear / slip);
    EXPECT_NEAR(limit.d_pressure, (near(h, 0, 0) - near(-h, 0, 0)) / (2 * h), scale) << name;
    EXPECT_NEAR(limit.d_shear_yield, (near(0, h, 0) - near(0, -h, 0)) / (2 * h), scale) << name;
    EXPECT_NEAR(limit.d_slip, (near(0, 0, h) - near(0, 0, -h)) / (2 * h), scale) << name;
  }
}

TEST(Friction, OfOneLawWithTheParametersOfAnotherIsThatLaw) {
  const auto limit = [](const Friction& friction, double p) {
    return limit_at(friction, {p, 250.0, 3.0, 0.1}, 0.02).shear;
  };
  Friction tabled = Coulomb{1.0};
  tabled.table = {{{{0.0, 1000.0}, {}, {}}}, {0.2, 0.2}};
  Friction grown = Coulomb{0.1};
  grown.evolution = {{{{}, {}, {0.0, 1.0}}}, {1.0, 2.0}};
  for (const double p : {1.0, 30.0, 400.0, 2000.0}) {
    EXPECT_DOUBLE_EQ(limit(tabled, p), limit(Coulomb{0.2}, p));
    EXPECT_DOUBLE_EQ(limit(grown, p), limit(Coulomb{0.2}, p)) << "3.02 mm are past the last point";
    EXPECT_DOUBLE_EQ(limit(Viscoplastic{50.0, 2.0, 1.0}, p), limit(ThickFilm{25.0, 1.0}, p));
    if (p > 100.0) { // below the cone of adhesion is narrower (F.3)
      EXPECT_DOUBLE_EQ(limit(Coulomb{1e3, 0.0, 100.0}, p), limit(Tresca{0.4, {}}, p)) << "capped";
    }
    EXPECT_DOUBLE_EQ(limit(Asperity{1.0, {}, 0.5}, p), limit(Shaw{{}, 0.5}, p));
    EXPECT_DOUBLE_EQ(limit(Coulomb{0.0}, p), limit(Frictionless{}, p));
  }
}

} // namespace
} // namespace billet::contact::friction_test
