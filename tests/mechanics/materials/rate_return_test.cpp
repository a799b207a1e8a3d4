// The return map of rate laws over many decades of rate, flow stress and time: VALIDATION MAT-06.

#include "mechanics/materials/j2_hencky.h"
#include "tests/support/figures.h"
#include "tests/support/point_driver.h"
#include "tests/support/point_response.h"
#include "tests/support/sample_materials.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace billet::mechanics::rate_return_test {
namespace {

using support::steel;

/// Rate laws whose flow stress is multiplied by `scale`, with a temperature for each.
std::vector<support::NamedMaterial> laws(double scale) {
  HanselSpittel hot = support::hot_steel;
  hot.A *= scale;
  JohnsonCook cook = support::steel_4340;
  cook.A *= scale;
  cook.B *= scale;
  return {{"norton", {steel, NortonHoff{100.0 * scale, 0.02, 0.0, 0.0, 0.0}}},
          {"newton", {steel, NortonHoff{100.0 * scale, 1.0, 0.0, 0.0, 0.0}}},
          {"norton-hoff", {steel, NortonHoff{100.0 * scale, 0.2, 0.3, 0.0, 0.0}}},
          {"with yield", {steel, NortonHoff{100.0 * scale, 0.2, 0.3, 0.0, 200.0 * scale}}},
          {"perzyna", {steel, Perzyna{Ludwik{200.0 * scale, 300.0 * scale, 0.3}, 1.0, 0.2}}},
          {"perzyna, m > 1", {steel, Perzyna{Voce{200.0 * scale, 300.0 * scale, 5.0}, 1.0, 3.0}}},
          {"johnson-cook", {steel, cook, 300.0}},
          {"molten", {steel, cook, 3000.0}},
          {"hansel-spittel", {steel, hot, 1000.0}}};
}

support::PointResponse
respond(const Material& material, double strain, const PointState& old, double dt) {
  const Mat3 b = Vec3(std::exp(2.0 * strain), std::exp(-strain), std::exp(-strain)).asDiagonal();
  support::PointResponse out;
  EXPECT_TRUE(support::update(material, {&b, 1}, {&old, 1}, false, {dt}, {&out, 1}));
  return out;
}

/// Error of q - 3 G d - sigma = 0 over q, and of the stress over the flow stress.
std::array<double, 2>
errors(const Material& material, double strain, const PointState& old, double dt) {
  const support::PointResponse at = respond(material, strain, old, dt);
  EXPECT_TRUE(at.s.allFinite() && at.normal_moduli.allFinite() && at.shear_moduli.allFinite());
  EXPECT_GE(at.plastic_increment, 0.0);
  // Of the strain as the predictor has it: exp(2 strain) has lost the digits of a small one.
  Vec3 eps = 0.5 * at.predictor.values.array().log();
  eps.array() -= eps.mean();
  const double q = std::sqrt(6.0) * steel.shear() * eps.norm();
  const double stress = std::sqrt(1.5) * at.s.norm();
  const double d = at.plastic_increment;
  if (std::min(d, d / dt) < std::numeric_limits<double>::min()) // no rate that a number could tell
    return {std::abs(q - stress) / q, 0.0};
  const double flow =
      yield_stress(material.flow, {old.plastic_strain + d, d / dt, material.temperature});
  return {std::abs(q - 3.0 * steel.shear() * d - flow) / q, std::abs(stress - flow) / flow};
}

TEST(RateReturn, finds_the_flow_over_20_decades_of_time_and_of_flow_stress) {
  constexpr double allowed = 1e-13;
  for (const auto& [name, ignored] : laws(1.0)) {
    double of_equation = 0.0;
    double of_stress = 0.0;
    for (double scale = 1e-8; scale < 2e5; scale *= 10.0)
      for (const auto& [other, material] : laws(scale)) {
        if (other != name)
          continue;
        for (double dt = 1e-10; dt < 2e10; dt *= 10.0)
          for (const double strain : {1e-9, 1e-5, 1e-3, 0.1, 1.0})
            for (const double old : {0.0, 0.3}) {
              const auto [e, s] = errors(material, strain, {Mat3::Identity(), old}, dt);
              of_equation = std::max(of_equation, e);
              of_stress = std::max(of_stress, s);
            }
      }
    support::show_error("MAT-06", name + ": q - 3 G d - sigma over q", of_equation, allowed);
    support::show_error("MAT-06", name + ": stress against flow stress", of_stress, allowed);
    EXPECT_LE(of_equation, allowed) << name;
    EXPECT_LE(of_stress, allowed) << name;
  }
}

// The slope of the stress in the direction of flow, from the moduli and by differences.
TEST(RateReturn, has_exact_moduli_over_20_decades_of_time) {
  constexpr double allowed = 1e-6; // VALIDATION ELT-07, of the elastic modulus and of itself
  for (const auto& [name, material] : laws(1.0)) {
    double worst = 0.0;
    for (double dt = 1e-10; dt < 2e10; dt *= 10.0) {
      constexpr double strain = 0.02;
      const PointState old{Mat3::Identity(), 0.2};
      const support::PointResponse at = respond(material, strain, old, dt);
      // d s_0 along the strain (1, -1/2, -1/2); the moduli hold -2 s for the geometric part.
      const double slope =
          (at.normal_moduli.row(0) * Vec3(1.0, -0.5, -0.5)).value() + 2.0 * at.s[0];
      double best = 1.0;
      for (double h = 1e-3; h > 1e-7; h *= 0.1) {
        const double up = respond(material, strain * (1.0 + h), old, dt).s[0];
        const double down = respond(material, strain * (1.0 - h), old, dt).s[0];
        const double difference = (up - down) / (2.0 * h * strain);
        // Differences of a stress that hardly changes are its rounding over the step.
        best = std::min(best, std::abs(slope - difference) /
                                  std::max(std::abs(slope), 1e-3 * std::abs(at.s[0]) / strain));
      }
      worst = std::max(worst, best);
      EXPECT_LE(best, allowed) << name << " dt " << dt;
    }
    support::show_error("MAT-06", name + ": moduli", worst, allowed);
  }
}

TEST(RateReturn, overstress_vanishes_with_eta) {
  const Swift base{700.0, 0.01, 0.2};
  const double limit =
      std::sqrt(1.5) * respond({steel, base}, 0.1, {Mat3::Identity(), 0.1}, 0.01).s.norm();
  for (const double m : {0.05, 0.2, 1.0})
    for (double eta = 1.0; eta > 1e-30; eta *= 1e-3) {
      const double stress =
          std::sqrt(1.5) *
          respond({steel, Perzyna{base, eta, m}}, 0.1, {Mat3::Identity(), 0.1}, 0.01).s.norm();
      EXPECT_GE(stress, limit * (1.0 - 1e-12));
      EXPECT_LE(stress, limit * (1.0 + 1e-12 + std::pow(11.0 * eta, m))) << eta << " " << m;
    }
}

TEST(RateReturn, refuses_what_is_no_number) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Mat3 b = Vec3(1.1, 1.0, 1.0).asDiagonal();
  const PointState old;
  support::PointResponse out;
  const Material broken{steel, NortonHoff{nan, 0.2, 0.0, 0.0, 0.0}};
  EXPECT_FALSE(support::update(broken, {&b, 1}, {&old, 1}, false, {0.1}, {&out, 1}));
  const Material sound{steel, NortonHoff{100.0, 0.2, 0.0, 0.0, 0.0}};
  EXPECT_FALSE(support::update(sound, {&b, 1}, {&old, 1}, false, {nan}, {&out, 1}));
}

// VALIDATION MAT-06b: Norton n = 5, A = 1e-15, E = 200e3, from 300 MPa at a fixed length.
TEST(RateReturn, MAT_06b_relaxation_is_that_of_backward_euler) {
  struct Row {
    int time;
    double euler, exact;
  };
  constexpr std::array rows{Row{1, 212.78, 181.40358}, Row{10, 111.11, 105.33308},
                            Row{100, 59.96, 59.437438}};
  // sigma = (rate / A)^(1/5) = sqrt(3) K (sqrt(3) rate)^0.2
  const NortonHoff norton{1000.0 / std::pow(std::numbers::sqrt3, 1.2), 0.2, 0.0, 0.0, 0.0};
  support::PointDriver point({{200e3, 0.3}, norton});
  point.set_dt(1e-12); // too short to creep
  point.go_uniaxial(300.0 / 200e3);
  EXPECT_NEAR(point.tau()(0, 0), 300.0, 1e-6);
  point.set_dt(1.0);
  int time = 0;
  for (const Row& row : rows) {
    for (; time < row.time; ++time)
      point.go_uniaxial(300.0 / 200e3);
    constexpr double digits = 0.005; // of the reference
    support::show("MAT-06b", fmt::format("stress after {} s", row.time), point.tau()(0, 0),
                  row.euler);
    support::show("MAT-06b", "the same against the exact solution", point.tau()(0, 0), row.exact);
    EXPECT_NEAR(point.tau()(0, 0), row.euler, digits);
  }
}

TEST(RateReturn, MAT_06b_relaxation_is_first_order_in_time) {
  const auto error = [](int steps) { // after 10 s
    const NortonHoff norton{1000.0 / std::pow(std::numbers::sqrt3, 1.2), 0.2, 0.0, 0.0, 0.0};
    support::PointDriver point({{200e3, 0.3}, norton});
    point.set_dt(1e-12);
    point.go_uniaxial(300.0 / 200e3);
    point.set_dt(10.0 / steps);
    for (int i = 0; i < steps; ++i)
      point.go_uniaxial(300.0 / 200e3);
    return point.tau()(0, 0) - 105.33308;
  };
  const double coarse = error(160);
  const double fine = error(320);
  support::show("MAT-06b", "order in time", std::log2(coarse / fine), 1.0);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.05);
}

// The same table: rate = <sigma - 200> / 1e6, that is eta = 5000 s over a yield stress of 200 MPa.
TEST(RateReturn, MAT_06b_linear_overstress_relaxes_to_the_yield_stress) {
  support::PointDriver point({{200e3, 0.3}, Perzyna{Perfect{200.0}, 5000.0, 1.0}});
  point.set_dt(1e-9);
  point.go_uniaxial(300.0 / 200e3);
  point.set_dt(0.01);
  for (int i = 0; i < 1000; ++i) {
    point.go_uniaxial(300.0 / 200e3);
    if (i == 99) {
      support::show("MAT-06b", "linear overstress after 1 s", point.tau()(0, 0), 281.87308);
      EXPECT_NEAR(point.tau()(0, 0), 200.0 + 100.0 / std::pow(1.002, 100), 1e-6);
      EXPECT_NEAR(point.tau()(0, 0), 281.87308, 1e-3 * 281.9); // VALIDATION
    }
  }
  EXPECT_NEAR(point.tau()(0, 0), 213.53353, 1e-3 * 213.5);
  point.set_dt(1e6);
  point.go_uniaxial(300.0 / 200e3);
  EXPECT_NEAR(point.tau()(0, 0), 200.0, 1e-3);
}

} // namespace
} // namespace billet::mechanics::rate_return_test
