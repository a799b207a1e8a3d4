// The integrators of the slide against closed forms and differences.

#include "contact/law/stick_slip.h"
#include "tests/support/contact_laws.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

namespace billet::contact::stick_slip_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double T = 30.0;   // slip limit of FRI-04 [MPa]
constexpr double K = 1000.0; // stiffness against slip of FRI-04 [MPa/mm]

double angle(const Vec2& v) { return std::atan2(v[1], v[0]) / degree; }

/// Slides along a straight path in equal increments at a pressure that changes linearly.
Vec2 walk(const SlipScheme& scheme, Vec2 shear, const Vec2& way, int n, Vec2 limits = {T, T}) {
  const Friction friction = Coulomb{1.0};
  double limit = limits[0];
  for (int i = 1; i <= n; ++i) {
    const double pressure = limits[0] + (limits[1] - limits[0]) * i / n;
    // The shear of the workpiece opposes the path; the references have it along.
    const SlipResult end =
        stick_slip(friction, scheme, {shear, -way / n, K, limit, {pressure, 0.0}});
    shear = end.shear;
    limit = end.limit;
  }
  return shear;
}

TEST(StickSlip, ExactIsTheClosedFormOfACorner) {
  // VALIDATION FRI-04, fri04_corner_90deg_exact.csv: s, angle of the shear.
  for (const auto& [s, reference] :
       {std::array{0.003, 5.7200525}, std::array{0.01, 18.754434}, std::array{0.02, 35.646519},
        std::array{0.03, 49.604937}, std::array{0.06, 74.585373}, std::array{0.1, 85.913794},
        std::array{0.2, 89.854167}}) {
    for (const int n : {1, 7}) {
      const Vec2 end = walk({Integrator::exact}, {T, 0.0}, {0.0, s}, n);
      std::printf("FRI-04 s = %.3f in %d: %.6f deg (%.6f)\n", s, n, angle(end), reference);
      EXPECT_NEAR(angle(end), reference, 1e-5); // printed to 8 digits
      EXPECT_NEAR(end.norm(), T, 1e-12 * T);
    }
  }
}

struct SchemeError {
  double s;
  int increments;
  double radial, midpoint1, midpoint5, midpoint20; ///< [deg]
};

TEST(StickSlip, SchemesHaveTheErrorsOfTheReference) {
  // VALIDATION FRI-04, fri04b_corner_scheme_errors_deg.csv.
  for (const SchemeError& row :
       {SchemeError{0.03, 1, -4.6049374, 3.5251649, 0.12435824, 0.0077378661},
        SchemeError{0.03, 8, -0.92674554, 0.048436912, 0.0019340375, 0.00012086897},
        SchemeError{0.06, 1, -11.150424, 15.414627, 0.41071315, 0.025399942},
        SchemeError{0.06, 4, -4.1662177, 0.64587971, 0.025399942, 0.0015864593},
        SchemeError{0.3, 1, -5.7053907, 67.385338, 0.0052024487, 0.0010127998},
        SchemeError{0.3, 16, -0.03573005, 0.0015217788, 6.7458257e-05, 4.2326611e-06}}) {
    const double exact = angle(walk({Integrator::exact}, {T, 0.0}, {0.0, row.s}, 1));
    const auto error = [&](const SlipScheme& scheme) {
      return angle(walk(scheme, {T, 0.0}, {0.0, row.s}, row.increments)) - exact;
    };
    std::printf("FRI-04b s = %.2f in %2d: radial %.4f, mid-point 1: %.4f, 5: %.5f, 20: %.6f deg\n",
                row.s, row.increments, error({Integrator::radial}),
                error({Integrator::midpoint, 1}), error({Integrator::midpoint, 5}),
                error({Integrator::midpoint, 20}));
    EXPECT_NEAR(error({Integrator::radial}), row.radial, 1e-5);
    EXPECT_NEAR(error({Integrator::midpoint, 5}), row.midpoint5, 1e-5);
    EXPECT_NEAR(error({Integrator::midpoint, 20}), row.midpoint20, 1e-5);
    // Beyond five times T / K one step of the rule turns the wrong way: see the next test.
    if (row.s / row.increments < 5.0 * T / K) {
      EXPECT_NEAR(error({Integrator::midpoint, 1}), row.midpoint1, 1e-5);
    }
    EXPECT_LT(std::abs(error({Integrator::midpoint})), 0.13) << "as many as the turn asks for";
  }
}

TEST(StickSlip, LagsBehindACircularPathAsItShould) {
  // VALIDATION fri04c: lag asin(T / (K R)) = 17.457603 degrees at R = .1.
  constexpr double R = 0.1;
  for (const SlipScheme& scheme :
       {SlipScheme{Integrator::exact}, SlipScheme{Integrator::midpoint}}) {
    constexpr int n = 400;
    Vec2 shear(T, 0.0);
    for (int i = 0; i < 3 * n; ++i) {
      const double a = 2.0 * std::numbers::pi * i / n;
      const double b = 2.0 * std::numbers::pi * (i + 1) / n;
      shear =
          walk(scheme, shear, R * Vec2(std::cos(b) - std::cos(a), std::sin(b) - std::sin(a)), 1);
    }
    const double direction = 90.0; // of the path at the end of a full turn
    EXPECT_NEAR(direction - angle(shear), 17.457603, 0.3);
  }
}

/// The path of (F.16) by many small steps of the rates.
Vec2 by_small_steps(Vec2 shear, const Vec2& way, Vec2 limits) {
  constexpr int n = 200000;
  double limit = limits[0];
  for (int i = 1; i <= n; ++i) {
    limit = limits[0] + (limits[1] - limits[0]) * i / n;
    shear += K * way / n;
    if (shear.norm() > limit)
      shear *= limit / shear.norm();
  }
  return shear;
}

TEST(StickSlip, ExactHoldsWhileThePressureChangesAndFromWithinTheLimit) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Vec2 limits = T * Vec2(1.0, 1.0 + 0.8 * share(generator));
    const Vec2 start = 0.7 * T * Vec2(share(generator), share(generator));
    const Vec2 way = 0.08 * Vec2(share(generator), share(generator));
    const Vec2 end = walk({Integrator::exact}, start, way, 1, limits);
    worst = std::max(worst, (end - by_small_steps(start, way, limits)).norm() / T);
  }
  std::printf("FRI-04 with changing pressure: largest difference from 200 000 steps %.1e\n", worst);
  EXPECT_LT(worst, 2e-5); // the small steps are first order: 1 / 200 000 of a path of 3 T / K
}

TEST(StickSlip, AnisotropicFrictionHasTheDirectionOfTheTensor) {
  // VALIDATION FRI-06: tau = -p Q d with Q = diag(.1, .3); slide direction, |tau|/p, its direction.
  Friction friction = Coulomb{1.0};
  const Mat2 Q = Vec2(0.1, 0.3).asDiagonal();
  for (const auto& [direction, size, shear_direction] :
       {std::array{0.0, 0.1, 0.0}, std::array{30.0, 0.17320508, 60.0},
        std::array{45.0, 0.2236068, 71.565051}, std::array{90.0, 0.3, 90.0}}) {
    constexpr double p = 100.0;
    constexpr double way = 50.0; // the elastic part of the path is 3e-2 mm
    const Vec2 d(std::cos(direction * degree), std::sin(direction * degree));
    SlipStep step{Vec2::Zero(), -way * d, K, 0.0, {p, 0.0}};
    SlipResult end{};
    for (int i = 0; i < 3; ++i) {
      end = stick_slip(friction, {}, step, Q);
      step.shear = end.shear;
    }
    EXPECT_EQ(end.status, Status::slip);
    EXPECT_NEAR(end.shear.norm() / p, size, 1e-8) << direction;
    EXPECT_NEAR(angle(end.shear), shear_direction, 1e-5) << direction;
    EXPECT_NEAR(end.shear.dot(d) / p, d.dot(Q * d), 1e-8) << "dissipation";
  }
}

TEST(StickSlip, AMultipleOfTheUnitTensorScalesTheCoefficient) {
  Friction scaled = Coulomb{1.0};
  const Mat2 Q = 0.2 * Mat2::Identity();
  for (const double way : {0.01, 0.5}) { // sticks, slides
    const SlipStep step{Vec2(3.0, 1.0), Vec2(-way, 0.4 * way), K, 20.0, {100.0, 0.0}};
    const SlipResult a = stick_slip(scaled, {}, step, Q);
    const SlipResult b = stick_slip(Coulomb{0.2}, {}, step);
    ASSERT_EQ(a.status, b.status);
    constexpr double rounding = 1e-11; // of the scalar equation of the slide, on 20 MPa
    EXPECT_NEAR((a.shear - b.shear).norm(), 0.0, rounding);
    EXPECT_NEAR((a.slip - b.slip).norm(), 0.0, rounding);
    EXPECT_NEAR(a.limit, b.limit, rounding);
  }
}

TEST(StickSlip, ForcedAnisotropicBlockSlidesAlongTheInverseTensor) {
  // FRI-06, the inverse problem: slip d ~ Q^-1 a for a predictor along a just outside the limit.
  const Mat2 Q = (Mat2() << 0.1, 0.0, 0.0, 0.3).finished();
  const double a = 60.0 * degree;
  const Vec2 limit = 100.0 / (Q.inverse() * Vec2(std::cos(a), std::sin(a))).norm() *
                     Vec2(std::cos(a), std::sin(a));
  const SlipStep step{limit, -1e-9 * Vec2(std::cos(a), std::sin(a)), K, 0.0, {100.0, 0.0}};
  const SlipResult end = stick_slip(Friction(Coulomb{1.0}), {}, step, Q);
  ASSERT_EQ(end.status, Status::slip);
  EXPECT_NEAR(angle(-end.slip), angle(Q.inverse() * Vec2(std::cos(a), std::sin(a))), 1e-4);
}

TEST(StickSlip, AFilmCreepsToItsSteadyShear) {
  // A film sheared at a constant speed: eta v / e once the elastic part has been taken up.
  const Friction film = ThickFilm{0.5, 0.01};
  constexpr double v = 0.4;
  Vec2 shear = Vec2::Zero();
  for (int i = 0; i < 60; ++i)
    shear =
        stick_slip(film, {}, {shear, Vec2(-0.1 * v, 0.0), K, 0.0, {100.0, 0.0, 0.0, 0.1}}).shear;
  EXPECT_NEAR(shear[0], 0.5 * v / 0.01, 1e-9);
}

TEST(StickSlip, AReversalOfAFilmIsMonotone) {
  // FRI-02 eq 10: no jump as the speed passes through zero.
  const Friction film = Viscoplastic{30.0, 10.0, 0.15};
  double last = -1e9;
  for (double v = -20.0; v <= 20.0; v += 0.01) {
    const SlipResult end =
        stick_slip(film, {}, {Vec2::Zero(), Vec2(-1e-3 * v, 0.0), 1e6, 0.0, {1e3, 0.0, 0.0, 1e-3}});
    EXPECT_GE(end.shear[0], last);
    last = end.shear[0];
  }
}

} // namespace
} // namespace billet::contact::stick_slip_test
