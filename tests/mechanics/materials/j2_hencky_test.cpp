// The return map against an independent one in extended precision, at its extremes.

#include "mechanics/materials/j2_hencky.h"
#include "tests/support/figures.h"
#include "tests/support/point_response.h"
#include "tests/support/reference_return_map.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace billet::mechanics::j2_hencky_test {
namespace {

using support::Long;
using support::LongMat3;
using support::steel;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double dt = 0.01; // of every increment [s]

Mat3 stress(const support::PointResponse& at) {
  const Mat3& n = at.predictor.vectors;
  return n * at.s.asDiagonal() * n.transpose();
}

Mat3 symmetrized(const Mat3& A) { return 0.5 * (A + A.transpose()); }

support::PointResponse
respond(const Material& material, const Mat3& b, const PointState& old = {}, bool planar = false) {
  support::PointResponse out;
  EXPECT_TRUE(support::update(material, {&b, 1}, {&old, 1}, planar, {dt}, {&out, 1}));
  return out;
}

std::function<Long(Long)> long_yield(const Material& material, double old) {
  return [&material, old](Long strain) -> Long {
    const auto rate = static_cast<double>((strain - Long(old)) / Long(dt));
    return Long(
        yield_stress(material.flow, {static_cast<double>(strain), rate, material.temperature}));
  };
}

/// Errors of stress (over 2 G) and state against the reference.
double error(const Material& material, const Mat3& b, const PointState& old, bool planar) {
  const support::PointResponse at = respond(material, b, old, planar);
  const auto reference =
      support::reference_return(material.elasticity, long_yield(material, old.plastic_strain),
                                b.cast<Long>(), Long(old.plastic_strain));
  const Mat3 s = reference.s.cast<double>();
  const Mat3 b_e = reference.b_e.cast<double>();
  return std::max((stress(at) - s).norm() / (2.0 * material.elasticity.shear()),
                  (at.state.b_e - b_e).norm() / b_e.norm());
}

/// Stretches of an isochoric extension by a logarithmic strain, turned by R.
Mat3 extension(double strain, const Mat3& R) {
  const Vec3 b(std::exp(2.0 * strain), std::exp(-1.2 * strain), std::exp(-0.8 * strain));
  return symmetrized(R * b.asDiagonal() * R.transpose());
}

TEST(J2Hencky, returns_exactly_for_increments_from_1e_12_to_10_and_any_hardening) {
  const Mat3 in_plane = support::rotation(Vec3::UnitZ(), 0.7);
  const Mat3 in_space = support::rotation(Vec3(1, -2, 0.5), 2.2);
  const FlowTable softening{{{0.0, 300.0}, {0.1, 350.0}, {1.0, 150.0}, {8.0, 10.0}}};
  const std::array<AnyFlowLaw, 7> laws{
      Perfect{300.0},      Linear{300.0, 1.0},       Linear{300.0, 2e5}, Linear{300.0, 2e9},
      Linear{1e-9, 300.0}, Voce{250.0, 450.0, 12.0}, softening};
  double worst = 0.0;
  for (const AnyFlowLaw& law : laws)
    for (double strain = 1e-12; strain < 11.0; strain *= 10.0)
      for (const double sign : {1.0, -1.0})
        for (const bool planar : {true, false}) {
          const Mat3 b = extension(sign * strain, planar ? in_plane : in_space);
          // Principal values are known to rounding of the largest: eps * ratio in the logarithm.
          const double ratio = std::exp(3.2 * strain);
          worst = std::max(worst, error({steel, law}, b, {}, planar) / (8.0 * eps * ratio));
        }
  support::show_error("J2", "return map, in units of 8 eps * stretch ratio", worst, 1.0);
  EXPECT_LE(worst, 1.0);
}

TEST(J2Hencky, stays_exact_at_equal_and_nearly_equal_principal_stretches) {
  double worst = 0.0;
  constexpr double allowed = 16.0 * eps;
  for (const double level : {1.0, 1.3})
    for (const double split : {0.0, 1e-16, 1e-15, 1e-13, 1e-10, 1e-7, 1e-4})
      for (const double third : {0.0, 1e-3, 0.4})
        for (const bool planar : {true, false}) {
          const Mat3 R = planar ? support::rotation(Vec3::UnitZ(), 0.4)
                                : support::rotation(Vec3(3, 1, -1), 1.1);
          const Vec3 b(level, level * (1.0 + split), level * (1.0 + third));
          const Mat3 predictor = symmetrized(R * b.asDiagonal() * R.transpose());
          for (const auto& [name, material] : support::every_material())
            worst = std::max(worst, error(material, predictor, {}, planar));
        }
  support::show_error("J2", "nearly equal stretches", worst, allowed);
  EXPECT_LE(worst, allowed);
}

/// Oldroyd rate of the deviatoric stress under a symmetric velocity gradient d, from the moduli.
Mat3 stress_rate(const support::PointResponse& at, const Mat3& d) {
  const Mat3& n = at.predictor.vectors;
  const Mat3 d_principal = n.transpose() * d * n;
  Mat3 rate = (at.normal_moduli * d_principal.diagonal()).asDiagonal();
  constexpr std::array<std::array<int, 2>, 3> shears{{{0, 1}, {1, 2}, {0, 2}}};
  for (int k = 0; k < 3; ++k) {
    const auto [i, j] = shears[static_cast<std::size_t>(k)];
    rate(i, j) = rate(j, i) = 2.0 * at.shear_moduli[k] * d_principal(i, j);
  }
  const Mat3 s = stress(at);
  return n * rate * n.transpose() + d * s + s * d;
}

/// The same by central differences of the reference in extended precision.
Mat3 reference_rate(const Material& material, const Mat3& b, const PointState& old, const Mat3& d) {
  constexpr Long h = 1e-6L;
  const auto s = [&](Long step) -> LongMat3 {
    const LongMat3 f = LongMat3::Identity() + step * d.cast<Long>();
    const LongMat3 moved = f * b.cast<Long>() * f.transpose();
    return support::reference_return(material.elasticity, long_yield(material, old.plastic_strain),
                                     moved, Long(old.plastic_strain))
        .s;
  };
  return ((s(h) - s(-h)) / (2.0L * h)).cast<double>();
}

TEST(J2Hencky, has_exact_moduli_at_distinct_nearly_equal_and_equal_stretches) {
  support::Random random(11);
  // Step 1e-6 leaves h^2 times third derivatives of (strain / yield strain)^2: 1e-7 at worst.
  constexpr double allowed = 2e-7;
  double worst = 0.0;
  // Laws that the reference can evaluate in extended precision without losing digits.
  for (const AnyFlowLaw& law : {AnyFlowLaw(Elastic{}), AnyFlowLaw(Linear{300.0, 500.0})})
    for (const double split : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.2})
      for (const double third : {0.0, 0.02, -0.1})
        for (const bool planar : {true, false}) {
          if (std::max(split, std::abs(third)) < 0.01 && law.index() != 0)
            continue; // does not yield, or hardly
          const Mat3 R = planar ? support::rotation(Vec3::UnitZ(), 0.9)
                                : support::rotation(random.vector(1.0), 0.8);
          const Vec3 b(1.1, 1.1 * (1.0 + split), 1.1 * (1.0 + third));
          const Mat3 predictor = symmetrized(R * b.asDiagonal() * R.transpose());
          const PointState old{Mat3::Identity(), 0.05};
          const Material material{steel, law};
          const Mat3 d = random.symmetric(1.0, planar);
          const Mat3 rate = stress_rate(respond(material, predictor, old, planar), d);
          const Mat3 reference = reference_rate(material, predictor, old, d);
          worst = std::max(worst, (rate - reference).norm() / reference.norm());
        }
  support::show_error("J2", "spatial moduli", worst, allowed);
  EXPECT_LE(worst, allowed);
}

TEST(J2Hencky, does_not_notice_a_rotation_by_any_angle) {
  support::Random random(5);
  double worst = 0.0;
  constexpr double allowed = 64.0 * eps; // of products with two rotations, on stretches to 1.5
  for (const auto& [name, material] : support::every_material())
    for (int i = 0; i < 100; ++i) {
      const Mat3 b = symmetrized(support::exponential(random.symmetric(0.2)));
      const Mat3 Q = support::rotation(random.vector(1.0), random.number(-7.0, 7.0));
      const Mat3 turned = symmetrized(Q * b * Q.transpose());
      const auto before = respond(material, b);
      const auto after = respond(material, turned);
      worst = std::max(worst, (stress(after) - Q * stress(before) * Q.transpose()).norm() /
                                  (2.0 * steel.shear()));
      worst = std::max(worst, (after.state.b_e - Q * before.state.b_e * Q.transpose()).norm());
      worst = std::max(worst, std::abs(after.state.plastic_strain - before.state.plastic_strain));
    }
  support::show_error("J2", "objectivity", worst, allowed);
  EXPECT_LE(worst, allowed);
}

TEST(J2Hencky, knows_how_far_a_law_has_softened) {
  const auto left = [](const AnyFlowLaw& flow, double strain) {
    return flow_stress_left(flow, {strain, 1.0, 1150.0});
  };
  EXPECT_EQ(left(Elastic{}, 0.0), 1.0);
  EXPECT_EQ(left(Perfect{300.0}, 5.0), 1.0);
  EXPECT_EQ(left(Swift{700.0, 0.01, 0.2}, 5.0), 1.0);
  const FlowTable table{{{0.0, 300.0}, {0.1, 400.0}, {0.5, 100.0}}};
  EXPECT_EQ(left(table, 0.05), 1.0);
  EXPECT_NEAR(left(table, 0.5), 0.25, 2e-3) << "the peak lies between two of the strains tried";
  HanselSpittel hot = support::hot_steel;
  EXPECT_LT(left(hot, 8.0), 0.25) << "the formula, far beyond its data";
  hot.eps_max = 1.0;
  EXPECT_GT(left(hot, 8.0), 0.75);
  EXPECT_NEAR(left(hot, 8.0), left(hot, 1.0), 1e-3);
}

TEST(J2Hencky, lands_on_the_yield_surface_keeps_the_volume_and_the_direction) {
  support::Random random(6);
  for (const auto& [name, material] : support::every_material()) {
    if (!support::yields(material))
      continue;
    for (int i = 0; i < 100; ++i) {
      const Mat3 b = symmetrized(support::exponential(random.symmetric(0.3)));
      const PointState old{Mat3::Identity(), random.number(0.0, 0.3)};
      const auto at = respond(material, b, old);
      ASSERT_GT(at.plastic_increment, 0.0) << name;
      const double yield =
          yield_stress(material.flow,
                       {at.state.plastic_strain, at.plastic_increment / dt, material.temperature});
      // The stress comes from beta = 1 - 3 G d / q with q up to 100 times the yield stress.
      constexpr double cancellation = 1e-12;
      EXPECT_NEAR(support::von_mises(stress(at)), yield, cancellation * yield) << name;
      EXPECT_NEAR(at.state.b_e.determinant(), b.determinant(), 64.0 * eps) << name;
      EXPECT_NEAR(at.log_J, 0.5 * std::log(b.determinant()), 64.0 * eps) << name;
      EXPECT_LE((stress(at) * b - b * stress(at)).norm(), 1e-12 * yield) << name;
      EXPECT_EQ(at.state.plastic_strain, old.plastic_strain + at.plastic_increment);
    }
  }
}

TEST(J2Hencky, answers_strains_of_any_size_without_a_yield_stress) {
  // K eps^n flows by (q / K)^(1/n): by 1e-130 under the rounding of a body at rest.
  constexpr double rounding = 16.0 * eps;
  for (const double n : {0.01, 0.1, 0.5})
    for (double strain = 1e-1; strain > 1e-19; strain *= 0.1) {
      const Material material{steel, Ludwik{0.0, 500.0, n}};
      const support::PointResponse at = respond(material, extension(strain, Mat3::Identity()));
      const Vec3 predictor = 0.5 * at.predictor.values.array().log();
      const double q_pred =
          std::sqrt(6.0) * steel.shear() * (predictor.array() - predictor.mean()).matrix().norm();
      const double q = std::sqrt(1.5) * at.s.norm();
      const double d = at.plastic_increment;
      EXPECT_NEAR(q + 3.0 * steel.shear() * d, q_pred, rounding * q_pred) << n << " " << strain;
      // Where it says that nothing flows it would flow by less than the rounding of the stress.
      const double least = rounding * q_pred / (3.0 * steel.shear());
      const double flow_stress = yield_stress(material.flow, {d > 0.0 ? d : least, 0.0, 0.0});
      EXPECT_LE(q, flow_stress * (1.0 + 1e-12)) << n << " " << strain;
      if (d > 0.0) {
        EXPECT_NEAR(q, flow_stress, 1e-12 * q) << n << " " << strain;
      }
      EXPECT_TRUE(at.normal_moduli.allFinite() && at.shear_moduli.allFinite());
    }
}

TEST(J2Hencky, refuses_predictors_without_a_logarithm) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<Mat3, 4> bad{
      Mat3::Constant(nan), Mat3(Vec3(1, -1e-3, 1).asDiagonal()), Mat3(Vec3(1, 0, 1).asDiagonal()),
      Mat3(Vec3(std::numeric_limits<double>::infinity(), 1, 1).asDiagonal())};
  for (const Mat3& b : bad)
    for (const bool planar : {true, false}) {
      const PointState old;
      support::PointResponse out;
      EXPECT_FALSE(
          support::update({steel, Perfect{300.0}}, {&b, 1}, {&old, 1}, planar, {dt}, {&out, 1}))
          << b;
    }
}

TEST(J2Hencky, stops_a_batch_at_its_bad_point_and_treats_the_others_one_by_one) {
  const std::array<Mat3, 2> b{Mat3(Vec3(1.1, 1, 1).asDiagonal()),
                              Mat3(Vec3(1, 1.2, 1).asDiagonal())};
  const std::array<PointState, 2> old{PointState{Mat3::Identity(), 0.1}, PointState{}};
  std::array<support::PointResponse, 2> out;
  const Material material{steel, Linear{300.0, 500.0}};
  ASSERT_TRUE(support::update(material, b, old, false, {dt}, out));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(out[i].state.plastic_strain, respond(material, b[i], old[i]).state.plastic_strain);
}

} // namespace
} // namespace billet::mechanics::j2_hencky_test
