#include "geometry/base/error.h"
#include "geometry/collision/facet_body.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/revolved_profile.h"
#include "tests/geometry/surface_checks.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace billet::geometry::revolved_profile_test {
namespace {

constexpr double rounding = 1e-12; // coordinates up to 10
constexpr double pi = std::numbers::pi;
const Vec3 origin(0.3, -0.2, 0.5);
const Vec3 tilt(1.0, 2.0, -2.0); // length 3

Profile lines(const std::vector<Vec2>& points, bool closed = false) {
  return polygon(points, closed);
}

SurfacePtr turned(const Profile& profile) { return make_revolved_profile(origin, tilt, profile); }

double height(const Vec3& x) { return (x - origin).dot(tilt.normalized()); }
double radius(const Vec3& x) { return (x - origin - height(x) * tilt.normalized()).norm(); }

// A grooved roll with a flank, fillets and side faces, h falling.
Profile groove() {
  Profile p;
  p.start = {2.0, 0.5};
  p.segments = {{{2.0, 2.3}},  {{1.8, 2.5}, 0.2}, {{1.0, 2.5}},  {{0.6, 2.1}, 0.4},
                {{0.4, 1.6}},  {{-0.6, 1.6}},     {{-1.2, 2.6}}, {{-1.5, 2.8}, 0.3},
                {{-2.0, 2.4}}, {{-2.0, 0.5}}};
  return p;
}

// A ring of lines and an arc, away from the axis.
Profile ring() {
  Profile p;
  p.start = {-0.5, 1.2};
  p.segments = {{{0.7, 1.2}}, {{0.7, 2.0}, 0.4}, {{-0.5, 2.4}}};
  p.closed = true;
  return p;
}

// A pointed bullet with a flat back; both ends on the axis.
Profile bullet() { return lines({{2.0, 0.0}, {0.5, 1.1}, {-1.5, 1.1}, {-1.5, 0.0}}); }

struct Example {
  std::string name;
  Profile profile;
};

std::vector<Example> examples() {
  return {{"groove", groove()}, {"ring", ring()}, {"bullet", bullet()}};
}

void expect_same(const Projection& p, const Projection& q, const Vec3& x, const std::string& name) {
  ASSERT_TRUE(p.found() && q.found()) << name;
  EXPECT_NEAR(p.gap, q.gap, rounding) << name << " at " << x.transpose();
  EXPECT_NEAR((p.foot - q.foot).norm(), 0.0, 2 * rounding) << name;
  EXPECT_NEAR((p.normal - q.normal).norm(), 0.0, rounding * (1.0 + q.dnormal_dx.norm())) << name;
  EXPECT_NEAR((p.dnormal_dx - q.dnormal_dx).norm(), 0.0,
              rounding * (1.0 + 10.0 * q.dnormal_dx.squaredNorm()))
      << name;
}

TEST(RevolvedProfile, AStraightLineAlongTheAxisIsACylinderAndTurnedRoundABore) {
  const SurfacePtr roll = turned(lines({{50.0, 1.3}, {-50.0, 1.3}}));
  const SurfacePtr bore = turned(lines({{-50.0, 1.3}, {50.0, 1.3}}));
  const SurfacePtr cylinder = make_cylinder(origin, tilt, 1.3, false);
  const SurfacePtr hollow = make_cylinder(origin, tilt, 1.3, true);
  for (const Vec3& x : random_points(500, 3.0)) {
    expect_same(projection(*roll, x), projection(*cylinder, x), x, "roll");
    expect_same(projection(*bore, x), projection(*hollow, x), x, "bore");
  }
}

TEST(RevolvedProfile, ASlantedLineFromTheAxisIsAConeWithItsApex) {
  const double half_angle = pi / 7, length = 100.0;
  const Vec2 rim(length * std::cos(half_angle), length * std::sin(half_angle));
  const SurfacePtr solid = turned(lines({rim, {0.0, 0.0}}));
  const SurfacePtr pit = turned(lines({{0.0, 0.0}, rim}));
  const SurfacePtr cone = make_cone(origin, tilt, half_angle, false);
  const SurfacePtr hollow = make_cone(origin, tilt, half_angle, true);
  for (const Vec3& x : random_points(500, 3.0)) {
    expect_same(projection(*solid, x), projection(*cone, x), x, "cone");
    expect_same(projection(*pit, x), projection(*hollow, x), x, "pit");
  }
}

TEST(RevolvedProfile, HalfACircleIsASphereAlsoAtItsPoles) {
  Profile half;
  half.start = {1.7, 0.0};
  half.segments = {{{-1.7, 0.0}, 1.7}};
  const SurfacePtr ball = turned(half), sphere = make_sphere(origin, 1.7, false);
  std::vector<Vec3> points = random_points(500, 3.0);
  for (const double h : {2.5, 1.0, -0.4, -2.0})
    points.push_back(origin + h * tilt.normalized());
  for (const Vec3& x : points)
    if ((x - origin).norm() > 0.05) // curvatures without bound at the centre
      expect_same(projection(*ball, x), projection(*sphere, x), x, "sphere");
}

TEST(RevolvedProfile, ACircleAwayFromTheAxisIsATorus) {
  Profile circle;
  circle.start = {0.6, 1.9};
  circle.segments = {{{-0.6, 1.9}, 0.6}, {{0.6, 1.9}, 0.6}};
  circle.closed = true;
  const SurfacePtr ring = turned(circle), torus = make_torus(origin, tilt, 1.9, 0.6, false);
  for (const Vec3& x : random_points(500, 3.0)) {
    const Projection p = projection(*torus, x);
    if (p.dnormal_dx.norm() < 20.0) // not close to the axis or the circle of centres
      expect_same(projection(*ring, x), p, x, "torus");
  }
}

TEST(RevolvedProfile, GapIsTheDistanceToADenseSampleWithTheSignOfTheSection) {
  constexpr int n = 400;
  const Vec3 a = tilt.normalized(), e = a.unitOrthogonal(), f = a.cross(e);
  for (const Example& example : examples()) {
    const SurfacePtr surface = turned(example.profile);
    std::vector<Vec2> line = polyline(example.profile, 0.01);
    if (example.profile.closed)
      line.push_back(line.front());
    std::vector<Vec3> sample;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const int cuts = static_cast<int>(std::ceil((line[i] - line[i - 1]).norm() / 0.04));
      for (int c = 0; c < cuts; ++c)
        for (int j = 0; j < n; ++j) {
          const Vec2 p = line[i - 1] + (line[i] - line[i - 1]) * c / cuts;
          const double angle = 2.0 * pi * j / n;
          sample.emplace_back(origin + p.x() * a +
                              p.y() * (std::cos(angle) * e + std::sin(angle) * f));
        }
    }
    // The section as a polygon down to the axis tells inside from outside.
    std::vector<Vec2> polygon = polyline(example.profile, 0.001);
    if (!example.profile.closed) {
      polygon.emplace_back(polygon.back().x(), 0.0);
      polygon.emplace_back(polygon.front().x(), 0.0);
    }
    int checked = 0;
    for (const Vec3& x : random_points(60, 3.5)) {
      const Vec2 at(height(x), radius(x));
      const Projection p = projection(*surface, x);
      if (!p.found())
        continue; // behind the rims of the open roll
      ++checked;
      double nearest = far;
      for (const Vec3& s : sample)
        nearest = std::min(nearest, (s - x).norm());
      EXPECT_LE(std::abs(p.gap), nearest + rounding) << example.name;
      EXPECT_GE(std::abs(p.gap), nearest - 0.05) << example.name;
      double turns = 0.0;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 u = polygon[i] - at, v = polygon[(i + 1) % polygon.size()] - at;
        turns += std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
      }
      EXPECT_EQ(p.gap<0.0, std::abs(turns)> pi) << example.name << " at " << at.transpose();
    }
    EXPECT_GT(checked, 40) << example.name;
  }
}

TEST(RevolvedProfile, NormalIsTheGradientOfTheGapAndDnormalDxItsDerivative) {
  for (const Example& example : examples()) {
    const SurfacePtr surface = turned(example.profile);
    int checked = 0;
    for (const Vec3& x : random_points(400, 3.0)) {
      if (!projection(*surface, x).found())
        continue;
      expect_consistent(*surface, x);
      checked += expect_derivatives(*surface, x) ? 1 : 0;
    }
    EXPECT_GT(checked, 300) << example.name;
  }
}

TEST(RevolvedProfile, ThePointOfABulletAndItsBackClose) {
  const SurfacePtr surface = make_revolved_profile(Vec3::Zero(), Vec3::UnitX(), bullet());
  EXPECT_NEAR(projection(*surface, {3.0, 0.0, 0.0}).gap, 1.0, rounding);
  EXPECT_EQ(projection(*surface, {3.0, 0.0, 0.0}).normal, Vec3(1, 0, 0));
  const Projection back = projection(*surface, {-2.0, 0.0, 0.0});
  EXPECT_NEAR(back.gap, 0.5, rounding);
  EXPECT_NEAR((back.normal - Vec3(-1, 0, 0)).norm(), 0.0, rounding);
  EXPECT_EQ(back.dnormal_dx, Mat3::Zero());
  EXPECT_NEAR(projection(*surface, {-1.4, 1e-13, 0.0}).gap, -0.1, rounding);
  EXPECT_NEAR(projection(*surface, {0.0, 0.0, 0.0}).gap, -1.1, rounding);
}

TEST(RevolvedProfile, TheMeridiansOfOneDistanceFromTheAxisAnswerAlike) {
  const SurfacePtr surface = turned(groove());
  const Vec3 a = tilt.normalized(), e = a.unitOrthogonal();
  const Vec3 x = origin + 0.2 * a + 2.2 * e;
  const Projection p = projection(*surface, x);
  for (int i = 1; i < 8; ++i) {
    const Eigen::AngleAxisd turn(0.7 * i, a);
    const Projection q = projection(*surface, origin + turn * (x - origin));
    EXPECT_NEAR(q.gap, p.gap, rounding);
    EXPECT_NEAR((q.normal - turn * p.normal).norm(), 0.0, 10 * rounding);
  }
}

TEST(RevolvedProfile, BeyondReachNothingIsFoundAndAHintChangesNoBit) {
  const SurfacePtr surface = turned(groove());
  for (const Vec3& x : random_points(300, 3.0)) {
    const Projection p = projection(*surface, x);
    if (!p.found())
      continue;
    EXPECT_FALSE(projection(*surface, x, 0.999 * std::abs(p.gap)).found());
    for (const std::int32_t hint : {0, 3, 9, 1000})
      EXPECT_TRUE(same_bits(p, projection(*surface, x, far, hint)));
  }
}

TEST(RevolvedProfile, BoundsHoldTheSurfaceAndAreTight) {
  for (const Example& example : examples()) {
    const SurfacePtr surface = turned(example.profile);
    Box sampled;
    const Vec3 a = tilt.normalized(), e = a.unitOrthogonal(), f = a.cross(e);
    for (const Vec2& p : polyline(example.profile, 0.01))
      for (int j = 0; j < 1000; ++j)
        sampled.add(origin + p.x() * a +
                    p.y() * (std::cos(2e-3 * pi * j) * e + std::sin(2e-3 * pi * j) * f));
    const Box box = surface->bounds();
    EXPECT_LT((box.low - sampled.low).cwiseAbs().maxCoeff(), 1e-4) << example.name;
    EXPECT_LT((box.high - sampled.high).cwiseAbs().maxCoeff(), 1e-4) << example.name;
    EXPECT_TRUE((box.low.array() <= sampled.low.array() + rounding).all());
    EXPECT_TRUE((box.high.array() >= sampled.high.array() - rounding).all());
  }
}

TEST(RevolvedProfile, DrawnTrianglesLieNearTheSurfaceAndFaceOutwards) {
  for (const Example& example : examples()) {
    const SurfacePtr surface = turned(example.profile);
    const DisplayMesh drawn = surface->display(surface->bounds(), false);
    EXPECT_GT(drawn.triangles.size(), 100U);
    for (const Vec3& x : drawn.points)
      EXPECT_NEAR(projection(*surface, x).gap, 0.0, rounding * 10) << example.name;
    for (const auto& t : drawn.triangles) {
      const Vec3 p = drawn.points.at(static_cast<std::size_t>(t[0]));
      const Vec3 q = drawn.points.at(static_cast<std::size_t>(t[1]));
      const Vec3 r = drawn.points.at(static_cast<std::size_t>(t[2]));
      const Vec3 area = (q - p).cross(r - p);
      EXPECT_GT(area.norm(), 0.0);
      EXPECT_GT(area.normalized().dot(projection(*surface, (p + q + r) / 3.0).normal), 0.8)
          << example.name;
    }
  }
  EXPECT_FALSE(turned(groove())->display({}, true).lines.empty());
}

TEST(RevolvedProfile, TheDrawingOfASolidThatTheAxisClosesIsClosed) {
  for (const auto& [name, profile] : examples())
    EXPECT_EQ(closed(turned(profile)->display({}, false)), name != "groove") << name;
}

TEST(RevolvedProfile, GapsScaleWithTheUnitOfLength) {
  for (const double unit : {1e-3, 1e6}) {
    Profile scaled = groove();
    scaled.start *= unit;
    for (ProfileSegment& s : scaled.segments) {
      s.to *= unit;
      s.radius *= unit;
    }
    const SurfacePtr big = turned(groove());
    const SurfacePtr other = make_revolved_profile(unit * origin, tilt, scaled);
    for (const Vec3& x : random_points(100, 3.0)) {
      const Projection p = projection(*big, x), q = projection(*other, unit * x, unit * far);
      ASSERT_EQ(p.found(), q.found());
      if (p.found()) {
        EXPECT_NEAR(q.gap / unit, p.gap, rounding);
      }
    }
  }
}

TEST(RevolvedProfile, WhatCannotBeTurnedIsRefused) {
  const auto flaw = [](const Profile& profile) {
    const std::vector<std::string> found = turning_flaws(profile);
    return found.empty() ? std::string() : found.front();
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(contains(flaw(lines({{1, 1}, {0, -1}})), "beyond the axis, at radius -1"));
  EXPECT_TRUE(contains(flaw(lines({{1, 0}, {0, 0}, {0, 1}})), "touches the axis"));
  EXPECT_TRUE(contains(flaw(lines({{2, 1}, {1, 0}, {0, 1}})), "touches the axis"));
  EXPECT_TRUE(contains(flaw(lines({{0, 0}, {1, 0}, {1, 1}}, true)), "touches the axis"));
  Profile dip;
  dip.start = {1, 1};
  dip.segments = {{{-1, 1}, -1.0}}; // a half circle down to the axis
  EXPECT_TRUE(contains(flaw(dip), "touches the axis"));
  EXPECT_EQ(flaw(lines({{1, 1}, {0, 1e-15}})), "");
  EXPECT_THROW((void)turned(dip), Error);
  EXPECT_THROW((void)make_revolved_profile(origin, Vec3::Zero(), bullet()), Error);
}

} // namespace
} // namespace billet::geometry::revolved_profile_test
