#include "contact/law/interface_law.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "tests/support/contact_laws.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <utility>

namespace billet::contact::interface_law_test {
namespace {

constexpr double rounding = 1e-12; // a few hundred units in the last place of 1

/// The plane y = 0 with the tool below, and a point d deep in it.
geometry::SurfacePtr floor_plane() { return geometry::make_plane({0, 0, 0}, {0, 1, 0}); }

PointHistory on_floor(double depth, const Vec3& shear = Vec3::Zero()) {
  PointHistory old;
  old.position = Vec3(0, -depth, 0);
  old.normal = Vec3::UnitY();
  old.shear = shear;
  return old;
}

TEST(InterfaceLaw, HasNoToleranceBandAtTheSurface) {
  // VALIDATION CON-08: gap 1e-9: nothing; penetration 1e-9: Kp 1e-9.
  const auto floor = floor_plane();
  const Traction apart = traction_at(*floor, Sticking{}, on_floor(0.01), {0, 1e-9, 0});
  EXPECT_EQ(apart.status, Status::open);
  EXPECT_EQ(apart.traction, Vec3::Zero());
  EXPECT_EQ(apart.dtraction_dx, Mat3::Zero());
  EXPECT_EQ(traction_at(*floor, Sticking{}, on_floor(0.01), {0, 0, 0}).traction, Vec3::Zero());
  EXPECT_EQ(traction_at(*floor, Sticking{}, PointHistory{}, {0, 1e-15, 0}).status, Status::open);
  const Traction touching = traction_at(*floor, Frictionless{}, PointHistory{}, {0, -1e-9, 0});
  EXPECT_DOUBLE_EQ(touching.pressure, test_penalty.normal * 1e-9);
  EXPECT_DOUBLE_EQ(touching.traction[1], test_penalty.normal * 1e-9);
}

TEST(InterfaceLaw, SticksElasticallyBelowTheLimitAndSlidesAtIt) {
  const auto floor = floor_plane();
  const double p = test_penalty.normal * 0.01; // 20 MPa
  const Coulomb law{0.3};
  const Traction stuck = traction_at(*floor, law, on_floor(0.01), {0.002, -0.01, 0});
  EXPECT_EQ(stuck.status, Status::stick);
  EXPECT_NEAR(stuck.shear[0], -test_penalty.tangent * 0.002, rounding * p);
  EXPECT_NEAR(stuck.slip.norm(), 0.0, rounding);
  const Traction slid = traction_at(*floor, law, on_floor(0.01), {0.03, -0.01, 0.04});
  EXPECT_EQ(slid.status, Status::slip);
  EXPECT_NEAR((slid.shear - 0.3 * p * Vec3(-0.6, 0, -0.8)).norm(), 0.0, rounding * p);
  EXPECT_NEAR(slid.slip.norm(), 0.05 - 0.3 * p / test_penalty.tangent, rounding);
}

/// Stiffness after a slide from rest to x = `way` over an element of depth 1 mm, pressed with 20
/// MPa.
double stiffness_after(const Friction& law, const Penalty& penalty, double way) {
  const auto floor = floor_plane();
  const PointHistory old = on_floor(0.01);
  const Vec3 end(way, -0.01, 0);
  const Traction now = traction(law, penalty, old, {end, foot_of(*floor, end)});
  return balance(penalty, old, now, now.slip.norm(), 1.0).stiffness;
}

TEST(InterfaceLaw, TurnsRoundWithinASmallPartOfTheWaySlid) {
  const Penalty stiff{2000.0, 1e6};
  const double limit = 0.3 * 20.0; // its own range is 6e-6 mm
  EXPECT_EQ(stiffness_after(Coulomb{0.3}, stiff, 5e-6), stiff.tangent) << "sticks";
  EXPECT_EQ(stiffness_after(Coulomb{0.3}, stiff, 1e-5), stiff.tangent);
  EXPECT_NEAR(stiffness_after(Coulomb{0.3}, stiff, 0.05), limit / (0.02 * 0.05),
              1e-3 * limit / 1e-3);
  EXPECT_DOUBLE_EQ(stiffness_after(Coulomb{0.3}, stiff, 5.0), limit / 0.005);
  EXPECT_EQ(stiffness_after(Frictionless{}, stiff, 5.0), stiff.tangent);
}

TEST(InterfaceLaw, SlidesAlongTheArcOfATurningRoll) {
  // A point that stays in space while a roll of radius 5 turns about z, and goes 0.3 along its
  // axis.
  const double radius = 5.0, depth = 0.01;
  const auto roll = geometry::make_cylinder(Vec3::Zero(), Vec3::UnitZ(), radius, false);
  PointHistory old;
  old.position = Vec3(radius - depth, 0, 0);
  old.normal = Vec3::UnitX();
  for (const double angle : {1e-6, 1e-3, 0.03, 0.0333, 0.1, 0.33, 1.0}) {
    const Vec3 end = (radius - depth) * Vec3(std::cos(angle), -std::sin(angle), 0);
    const Vec3 around(-std::sin(angle), -std::cos(angle), 0);
    for (const double along : {0.0, 0.3}) {
      const Traction slid = traction_at(*roll, Frictionless{}, old, end + Vec3(0, 0, along));
      const Vec3 way = (radius - depth) * angle * around + Vec3(0, 0, along);
      EXPECT_NEAR((slid.slip - way).norm(), 0.0, 1e-12 * radius) << angle;
    }
  }
}

TEST(InterfaceLaw, ResistsSlipWithTheStiffnessOfItsHistory) {
  const auto floor = floor_plane();
  PointHistory old = on_floor(0.01);
  const Vec3 end(1e-3, -0.01, 0);
  EXPECT_NEAR(traction_at(*floor, Coulomb{0.3}, old, end).shear[0], -1e-3 * test_penalty.tangent,
              rounding);
  old.stiffness = 500.0;
  EXPECT_NEAR(traction_at(*floor, Coulomb{0.3}, old, end).shear[0], -1e-3 * 500.0, rounding);
}

TEST(InterfaceLaw, GainsNothingFromAChangeOfItsStiffness) {
  // To and fro under one pressure, the stiffness falling with the way: work done = lost + stored.
  const auto floor = floor_plane();
  const Penalty stiff{2000.0, 1e5};
  constexpr int steps = 100;
  PointHistory old = on_floor(0.01);
  double done = 0.0, friction = 0.0, way = 0.0;
  for (const double leg : {0.5, -0.001, -0.0005, -0.3, 0.0001, 0.7, -0.001, 0.0001})
    for (int step = 0; step < steps; ++step) {
      const Vec3 end = old.position + Vec3(leg / steps, 0, 0);
      const Traction now = traction(Coulomb{0.3}, stiff, old, {end, foot_of(*floor, end)});
      done -= 0.5 * (old.shear + now.shear)[0] * leg / steps;
      way += std::abs(leg) / steps;
      const double sliding = old.sliding + now.slip.norm();
      const ShearBalance after = balance(stiff, old, now, sliding, 1.0);
      EXPECT_GE(after.friction_work, -rounding * done);
      friction += after.friction_work;
      EXPECT_NEAR(done, friction + shear_energy(now.shear, after.stiffness), rounding * done);
      old = PointHistory{end, Vec3::UnitY(), now.shear, now.pressure, sliding, after.stiffness};
    }
  EXPECT_NEAR(friction, 0.3 * 20.0 * way, 0.02 * friction); // the trapezoids at the turns
}

TEST(InterfaceLaw, TakesTheFirstAxisOfATensorInThePlaneWhereItsDirectionIsNormal) {
  Friction friction = Coulomb{1.0};
  friction.tensor = FrictionTensor{Vec2(0.1, 0.3).asDiagonal(), Vec3::UnitY()};
  const Traction slid = traction_at(*floor_plane(), friction, on_floor(0.01), {1.0, -0.01, 0});
  EXPECT_EQ(slid.status, Status::slip);
  EXPECT_NEAR(slid.shear[0], -0.1 * test_penalty.normal * 0.01, rounding * test_penalty.normal);
}

TEST(InterfaceLaw, SwitchesFromStickToSlipWithoutAJump) {
  const auto floor = floor_plane();
  const Coulomb law{0.3};
  const double border = 0.3 * test_penalty.normal * 0.01 / test_penalty.tangent;
  const double little = 1e-9 * border;
  const Traction below = traction_at(*floor, law, on_floor(0.01), {border - little, -0.01, 0});
  const Traction above = traction_at(*floor, law, on_floor(0.01), {border + little, -0.01, 0});
  EXPECT_EQ(below.status, Status::stick);
  EXPECT_EQ(above.status, Status::slip);
  EXPECT_NEAR((below.shear - above.shear).norm(), 0.0, 1e-8); // 2 Kt little and rounding
}

TEST(InterfaceLaw, LetsAPointThatTouchesFirstRubOverTheShareOfItsWay) {
  // (C.42): Coulomb's shear at the end, the slide of the share less what the stiffness holds.
  const auto floor = floor_plane();
  constexpr double mu = 0.3, share = 0.25, way = 0.4, depth = 0.01;
  PointHistory open;
  open.position = Vec3(-0.3, 0.2, 0.0);
  const Traction t = traction_at(*floor, Coulomb{mu}, open, {-0.3 + way, -depth, 0.0}, {}, share);
  const double shear = mu * test_penalty.normal * depth;
  EXPECT_EQ(t.status, Status::slip);
  EXPECT_NEAR((t.shear - Vec3(-shear, 0, 0)).norm(), 0.0, rounding * shear);
  const double slip = share * way - shear / test_penalty.tangent;
  EXPECT_NEAR((t.slip - Vec3(slip, 0, 0)).norm(), 0.0, rounding);
}

TEST(InterfaceLaw, GivesAPointThatTouchesFirstNoMoreShearThanPressure) {
  const auto floor = floor_plane();
  PointHistory open;
  open.position = Vec3(-0.3, 0.2, 0.0);
  for (const double depth : {1e-7, 1e-4, 1e-2}) {
    const double p = test_penalty.normal * depth;
    for (const auto& [name, law] : every_law()) {
      if (law.tensor)
        continue;
      const Traction t = traction_at(*floor, law, open, {0.1, -depth, 0.0}, {}, 0.5);
      EXPECT_LE(t.shear.norm(), p * (1.0 + rounding)) << name;
    }
    const Traction stuck = traction_at(*floor, Sticking{}, open, {0.1, -depth, 0.0}, {}, 0.5);
    EXPECT_NEAR(stuck.shear.norm(), p, rounding * p);
  }
}

TEST(InterfaceLaw, GivesARateLawTheSpeedOfThePointThatTouchesFirst) {
  // Half of the way in half of the time: the speed, and so the shear, is that of the whole.
  const auto floor = floor_plane();
  const Friction law = Viscoplastic{40.0, 0.1, 0.15};
  PointHistory open;
  open.position = Vec3(-0.3, 0.2, 0.0);
  const Vec3 end(3.7, -0.1, 0.0); // the shear's elastic part is small compared with the way
  const double whole = traction_at(*floor, law, open, end, {}, 1.0).shear.norm();
  EXPECT_NEAR(traction_at(*floor, law, open, end, {}, 0.5).shear.norm(), whole, 2e-3 * whole);
}

TEST(InterfaceLaw, LetsAPointThatTouchesUnpredictedSlideFreelyUntilTheIncrementEnds) {
  const auto floor = floor_plane();
  for (const auto& [name, law] : every_law()) {
    PointHistory open;
    open.position = Vec3(-0.3, 0.2, 0.0);
    const Traction t = traction_at(*floor, law, open, {0.1, -0.01, 0.0});
    EXPECT_EQ(t.status, Status::slip) << name;
    EXPECT_EQ(t.shear, Vec3::Zero()) << name;
    EXPECT_EQ(t.slip, Vec3::Zero()) << name << ": what it slid before it touched is not counted";
  }
}

TEST(InterfaceLaw, BoundsShearByAConeWhereTheLawDoesNot) {
  // Laws that carry shear without pressure carry as much as the pressure at the most, others as
  // much as they say (F.3).
  const auto floor = floor_plane();
  const double depth = 1e-5, p = test_penalty.normal * depth;
  const Traction t = traction_at(*floor, Sticking{}, on_floor(depth), {1.0, -depth, 0.0});
  EXPECT_EQ(t.status, Status::slip);
  EXPECT_NEAR(t.shear.norm(), p, rounding * p);
  const Traction steep =
      traction_at(*floor, Coulomb{.mu = 10.0}, on_floor(depth), {1.0, -depth, 0.0});
  EXPECT_NEAR(steep.shear.norm(), 10.0 * p, rounding * 10.0 * p);
}

TEST(InterfaceLaw, IsFrictionlessToTheLastBitWithZeroCoefficient) {
  // VALIDATION FRI-07: mu = 0 gives the same result as no friction.
  const auto ball = geometry::make_sphere({0, 0, 0}, 2.0, false);
  std::mt19937 generator(11);
  for (int i = 0; i < 50; ++i) {
    const Vec3 near = random_vector(generator);
    const PointHistory old = closed_history(*ball, near, 0.01, Vec3::Zero());
    const Vec3 x = old.position + 0.01 * random_vector(generator);
    const Traction none = traction_at(*ball, Frictionless{}, old, x);
    const Traction zero = traction_at(*ball, Coulomb{0.0}, old, x);
    EXPECT_EQ(none.traction, zero.traction);
    EXPECT_EQ(none.dtraction_dx, zero.dtraction_dx);
  }
}

TEST(InterfaceLaw, TurnsShearIntoTheNewPlaneKeepingItsLength) {
  std::mt19937 generator(7);
  double worst_length = 0.0, worst_normal = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = random_vector(generator).normalized();
    const Vec3 to = random_vector(generator).normalized();
    if (from.dot(to) < -0.9) // nearly a half turn: 1 / (1 + cos) magnifies rounding
      continue;
    const Vec3 v = from.cross(random_vector(generator));
    const Vec3 turned = turn(v, from, to);
    worst_length = std::max(worst_length, std::abs(turned.norm() - v.norm()));
    worst_normal = std::max(worst_normal, std::abs(turned.dot(to)));
    // The smallest rotation leaves the axis from x to alone.
    const Vec3 axis = from.cross(to).normalized();
    EXPECT_NEAR(turned.dot(axis), v.dot(axis), rounding * 10.0);
  }
  std::printf("turn: length changed by %.1e, out of plane %.1e\n", worst_length, worst_normal);
  EXPECT_LT(worst_length, 1e-14 * 10.0 * 10.0); // |v| of order 1, c down to 0.1 squared
  EXPECT_LT(worst_normal, 1e-14 * 10.0 * 10.0);
  EXPECT_EQ(turn(Vec3(1, 0, 0), Vec3::UnitY(), Vec3::UnitY()), Vec3(1, 0, 0));
}

/// Slides fully along +x, then by `path` along +y in equal increments; angle of the shear [deg].
double corner_angle(double path, int increments) {
  // VALIDATION FRI-04: T = 30, Kt = 1000.
  const Penalty penalty{1000.0, 1000.0};
  const auto floor = floor_plane();
  const Coulomb law{0.3};
  PointHistory old = on_floor(0.1, Vec3(-30.0, 0, 0));
  for (int i = 1; i <= increments; ++i) {
    const Vec3 x = old.position + Vec3(0, 0, path / increments);
    const Traction t = traction(law, penalty, old, {x, foot_of(*floor, x), 0.0});
    old.position = x;
    old.shear = t.shear;
  }
  return std::atan2(-old.shear[2], -old.shear[0]) * 180.0 / std::numbers::pi;
}

TEST(InterfaceLaw, RoundsACornerOfThePathAsTheRadialReturnDoes) {
  // fri04b_corner_scheme_errors_deg.csv, column radial_return; exact angle of fri04.
  constexpr double exact = 49.604937, digits = 1e-6; // as many as the file has
  const std::array<std::pair<int, double>, 4> errors{
      {{1, -4.6049374}, {4, -1.7140179}, {16, -0.48263892}, {64, -0.12450371}}};
  for (const auto& [n, error] : errors) {
    const double angle = corner_angle(0.03, n);
    std::printf("corner, %2d increments: %.6f deg, error %.6f, reference %.6f\n", n, angle,
                angle - exact, error);
    EXPECT_NEAR(angle - exact, error, digits);
  }
}

TEST(InterfaceLaw, GivesTheSamePressureAtAnApexHoweverManySteps) {
  // VALIDATION CON-05: a contactor passes a cylinder's apex: p = Kp d(x), whatever the steps.
  const auto roll = geometry::make_cylinder({0, 0, 0}, {0, 0, 1}, 10.0, false);
  const Vec3 start(-1.0, 9.94, 0.0), apex(0.0, 9.99, 0.0);
  const double exact = test_penalty.normal * 0.01;
  for (const int steps : {1, 3, 64}) {
    PointHistory old;
    old.position = start;
    old.normal = foot_of(*roll, start).normal;
    Traction t;
    for (int i = 1; i <= steps; ++i) {
      const Vec3 x = start + (apex - start) * i / steps;
      t = traction_at(*roll, Frictionless{}, old, x);
      old.position = x;
      old.normal = foot_of(*roll, x).normal;
    }
    std::printf("apex after %2d steps: p = %.12f MPa, Kp d = %.12f\n", steps, t.pressure, exact);
    EXPECT_NEAR(t.pressure, exact, 1e-14 * 10.0 * test_penalty.normal); // rounding of 10 mm
  }
}

TEST(InterfaceLaw, SlidesAlongTheArcOfAToolThatSpins) {
  // A point at rest 5 mm off the axis of a plate that turns 0.3 rad an increment.
  const auto plate = geometry::make_plane({0, 0, 0}, {0, 0, 1});
  constexpr double turn = 0.3, radius = 5.0, depth = 0.02;
  constexpr int steps = 6;
  const Coulomb law{.mu = 0.1};
  PointHistory old = closed_history(*plate, Vec3(radius, 0, 0), depth, Vec3::Zero());
  const double limit = 0.1 * depth * test_penalty.normal;
  old.limit = limit;
  double work = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double at = -turn * i; // in the tool's frame
    const Vec3 x(radius * std::cos(at), radius * std::sin(at), -depth);
    const Traction t = traction_at(*plate, law, old, x, {}, 0.0, Vec3(0, 0, turn));
    ASSERT_EQ(t.status, Status::slip);
    // The shear goes with the plate, at a right angle to the radius.
    const Vec3 along(-std::sin(at), std::cos(at), 0.0);
    EXPECT_NEAR(t.shear.norm(), limit, 1e-9 * limit);
    EXPECT_LT(t.shear.cross(along).norm(), 2e-3 * limit) << "what is elastic lags";
    old.sliding += t.slip.norm();
    const ShearBalance balanced = balance(test_penalty, old, t, old.sliding, 1.0);
    work += balanced.friction_work;
    old.position = x;
    old.shear = t.shear;
    old.limit = t.limit;
    old.stiffness = balanced.stiffness;
    old.slips = true;
  }
  EXPECT_NEAR(old.sliding, radius * turn * steps, 1e-3 * radius * turn * steps);
  EXPECT_NEAR(work, limit * radius * turn * steps, 2e-3 * limit * radius * turn * steps);
}

TEST(InterfaceLaw, NeverGainsEnergyOnARandomWalk) {
  const auto ball = geometry::make_sphere({0, 0, 0}, 0.5, false);
  std::mt19937 generator(5);
  for (const auto& [name, law] : every_law()) {
    PointHistory old = closed_history(*ball, Vec3(0.3, 0.4, 0.0), 0.02, Vec3::Zero());
    double least = 0.0, total = 0.0;
    for (int i = 0; i < 2000; ++i) {
      // Wander over the ball, sometimes off it.
      const Vec3 goal = (old.position + 0.02 * random_vector(generator)).normalized();
      const Vec3 x = (0.5 - 0.02 * (random_vector(generator)[0] + 0.8)) * goal;
      const Traction t = traction_at(*ball, law, old, x);
      const double dissipated = -t.shear.dot(t.slip);
      least = std::min(least, dissipated);
      total += dissipated;
      EXPECT_GE(t.pressure, 0.0);
      old.position = x;
      old.normal = t.status == Status::open ? Vec3(Vec3::Zero()) : foot_of(*ball, x).normal;
      old.shear = t.shear;
      old.limit = t.limit;
    }
    EXPECT_GE(least, -rounding) << name;
    EXPECT_EQ(total > 0.0, !std::holds_alternative<Frictionless>(law.law)) << name;
  }
}

} // namespace
} // namespace billet::contact::interface_law_test
