#include "geometry/base/error.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "tests/geometry/surface_checks.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace billet::geometry::analytic_surfaces_test {
namespace {

constexpr double rounding = 1e-12; // coordinates up to 10
constexpr double pi = std::numbers::pi;

// A surface, a dense sample of its points, and which points are inside the solid.
struct Example {
  std::string name;
  SurfacePtr outside;
  SurfacePtr inside;
  std::function<bool(const Vec3&)> in_solid;
  std::vector<Vec3> sample;
  double spacing; // no point of the surface near the queries is farther from the sample
};

const Vec3 origin(0.3, -0.2, 0.5);
const Vec3 tilt(1.0, 2.0, -2.0); // length 3

struct Frame {
  Vec3 a = tilt.normalized();
  Vec3 e = a.unitOrthogonal();
  Vec3 f = a.cross(e);
  [[nodiscard]] Vec3 at(double h, double r, double angle) const {
    return origin + h * a + r * (std::cos(angle) * e + std::sin(angle) * f);
  }
};

// Turns points (h, r) about the tilted axis.
std::vector<Vec3> turned(const std::vector<Vec2>& meridian, int n) {
  const Frame frame;
  std::vector<Vec3> points;
  for (const Vec2& p : meridian)
    for (int j = 0; j < n; ++j)
      points.push_back(frame.at(p.x(), p.y(), 2.0 * pi * j / n));
  return points;
}

double height(const Vec3& x) { return (x - origin).dot(tilt.normalized()); }
double distance(const Vec3& x) { return (x - origin - height(x) * tilt.normalized()).norm(); }

std::vector<Example> examples() {
  constexpr int n = 240;
  const double half_angle = pi / 7;
  std::vector<Vec2> line, ray, ball, ring;
  for (int i = 0; i <= n; ++i) {
    const double u = static_cast<double>(i) / n;
    line.emplace_back(20.0 * u - 10.0, 1.3);
    ray.emplace_back(12.0 * u * std::cos(half_angle), 12.0 * u * std::sin(half_angle));
    ball.emplace_back(1.7 * std::cos(pi * u), 1.7 * std::sin(pi * u));
    ring.emplace_back(0.6 * std::sin(2 * pi * u), 1.9 + 0.6 * std::cos(2 * pi * u));
  }
  std::vector<Example> all;
  all.push_back({"cylinder", make_cylinder(origin, tilt, 1.3, false),
                 make_cylinder(origin, tilt, 1.3, true),
                 [](const Vec3& x) { return distance(x) < 1.3; }, turned(line, n), 0.06});
  all.push_back({"sphere", make_sphere(origin, 1.7, false), make_sphere(origin, 1.7, true),
                 [](const Vec3& x) { return (x - origin).norm() < 1.7; }, turned(ball, n), 0.05});
  all.push_back(
      {"cone", make_cone(origin, tilt, half_angle, false),
       make_cone(origin, tilt, half_angle, true),
       [half_angle](const Vec3& x) { return std::atan2(distance(x), height(x)) < half_angle; },
       turned(ray, n), 0.1});
  all.push_back({"torus", make_torus(origin, tilt, 1.9, 0.6, false),
                 make_torus(origin, tilt, 1.9, 0.6, true),
                 [](const Vec3& x) { return std::hypot(height(x), distance(x) - 1.9) < 0.6; },
                 turned(ring, n), 0.06});
  return all;
}

TEST(AnalyticSurfaces, GapIsTheDistanceToADenseSampleWithTheSignOfTheSolid) {
  for (const Example& example : examples())
    for (const Vec3& x : random_points(150, 3.0)) {
      double nearest = far;
      for (const Vec3& s : example.sample)
        nearest = std::min(nearest, (s - x).norm());
      const double gap = projection(*example.outside, x).gap;
      EXPECT_LE(std::abs(gap), nearest + rounding) << example.name;
      EXPECT_GE(std::abs(gap), nearest - example.spacing) << example.name;
      EXPECT_EQ(gap < 0.0, example.in_solid(x)) << example.name << " at " << x.transpose();
    }
}

TEST(AnalyticSurfaces, MetalInsideFlipsGapAndNormalOnly) {
  for (const Example& example : examples())
    for (const Vec3& x : random_points(50, 3.0)) {
      const Projection p = projection(*example.outside, x), q = projection(*example.inside, x);
      EXPECT_EQ(p.gap, -q.gap);
      EXPECT_EQ(p.normal, -q.normal);
      EXPECT_EQ(p.dnormal_dx, -q.dnormal_dx);
      EXPECT_EQ(p.foot, q.foot);
    }
}

TEST(AnalyticSurfaces, NormalIsTheGradientOfTheGapAndDnormalDxItsDerivative) {
  for (const Example& example : examples()) {
    int checked = 0;
    for (const Vec3& x : random_points(200, 3.0)) {
      expect_consistent(*example.outside, x);
      checked += expect_derivatives(*example.outside, x) ? 1 : 0;
      expect_derivatives(*example.inside, x);
    }
    EXPECT_GT(checked, 150) << example.name; // the others are close to an axis or a centre
  }
}

TEST(AnalyticSurfaces, PointsOnTheAxisOrAtACentreGiveAFixedUnitNormal) {
  const Frame frame;
  for (const Example& example : examples())
    for (const Vec3& x : {origin, frame.at(0.7, 0.0, 0.0), frame.at(-0.7, 0.0, 0.0),
                          frame.at(0.0, 1.9, 0.4), frame.at(1.7, 0.0, 0.0)})
      for (const RigidSurface* surface : {example.outside.get(), example.inside.get()}) {
        const Projection p = projection(*surface, x);
        EXPECT_TRUE(p.found());
        EXPECT_NEAR(p.normal.norm(), 1.0, rounding) << example.name;
        EXPECT_TRUE(p.dnormal_dx.allFinite());
        EXPECT_TRUE(same_bits(p, projection(*surface, x)));
        EXPECT_NEAR(projection(*surface, p.foot).gap, 0.0, rounding) << example.name;
      }
}

TEST(AnalyticSurfaces, ThePlaneGivesTheHeightAboveItAndNoCurvature) {
  const SurfacePtr plane = make_plane(origin, tilt);
  for (const Vec3& x : random_points(100, 3.0)) {
    const Projection p = projection(*plane, x);
    EXPECT_NEAR(p.gap, (x - origin).dot(tilt) / 3.0, rounding);
    EXPECT_EQ(p.dnormal_dx, Mat3::Zero());
    expect_consistent(*plane, x);
    expect_derivatives(*plane, x);
  }
}

TEST(AnalyticSurfaces, BehindTheApexOfAConeTheNormalIsRadial) {
  const SurfacePtr cone = make_cone(Vec3::Zero(), Vec3::UnitY(), pi / 6, false);
  const Vec3 behind(0.1, -1.0, 0.0);
  const Projection p = projection(*cone, behind);
  EXPECT_NEAR(p.gap, behind.norm(), rounding);
  EXPECT_NEAR((p.normal - behind.normalized()).norm(), 0.0, rounding);
  EXPECT_NEAR(p.foot.norm(), 0.0, rounding);
  EXPECT_EQ(projection(*cone, Vec3::Zero()).normal, Vec3(0.0, -1.0, 0.0));
}

TEST(AnalyticSurfaces, InThePlaneNothingHasAZComponent) {
  std::vector<SurfacePtr> surfaces;
  surfaces.push_back(make_circle({0.2, 0.1, 5.0}, 1.5, false));
  surfaces.push_back(make_circle({0.2, 0.1, 0.0}, 1.5, true));
  surfaces.push_back(make_plane({0, 1, 0}, {1, 2, 0}));
  surfaces.push_back(make_cone({0, 1, 0}, {1, 2, 0}, 0.5, false));
  surfaces.push_back(make_cylinder({0, 1, 0}, {0, 2, 0}, 0.5, false));
  surfaces.push_back(make_sphere({0, 1, 0}, 0.5, false));
  surfaces.push_back(make_torus({0, 1, 0}, {0, 1, 0}, 1.5, 0.4, false));
  std::vector<Vec3> points = random_points(60, 3.0, true);
  points.insert(points.end(), {{0, 0, 0}, {0, 1, 0}, {0.2, 0.1, 0}, {1.5, 1, 0}, {0, 2, 0}});
  for (const SurfacePtr& surface : surfaces)
    for (const Vec3& x : points) {
      const Projection p = projection(*surface, x);
      EXPECT_EQ(p.normal.z(), 0.0);
      EXPECT_EQ(p.foot.z(), 0.0);
      EXPECT_NEAR(p.normal.norm(), 1.0, rounding);
      expect_derivatives(*surface, x, true);
    }
}

TEST(AnalyticSurfaces, TheCircleIgnoresZ) {
  const SurfacePtr circle = make_circle({0.2, 0.1, 5.0}, 1.5, false);
  EXPECT_NEAR(projection(*circle, {3.2, 4.1, 0.0}).gap, 3.5, rounding);
  EXPECT_EQ(circle->bounds().low, Vec3(-1.3, -1.4, 0.0));
  EXPECT_EQ(circle->bounds().high, Vec3(1.7, 1.6, 0.0));
}

TEST(AnalyticSurfaces, PointsBeyondReachAreNotFoundOnEitherSide) {
  for (const Example& example : examples())
    for (const Vec3& x : random_points(100, 3.0)) {
      const double gap = projection(*example.outside, x).gap;
      EXPECT_FALSE(projection(*example.outside, x, 0.999 * std::abs(gap)).found());
      EXPECT_TRUE(projection(*example.outside, x, 1.001 * std::abs(gap)).found());
    }
  const SurfacePtr plane = make_plane({0, 0, 0}, {0, 1, 0});
  EXPECT_FALSE(projection(*plane, {0, -2, 0}, 1.0).found());
  EXPECT_FALSE(projection(*plane, {0, 2, 0}, 1.0).found());
}

TEST(AnalyticSurfaces, BoundsHoldTheSurfaceAndAreTight) {
  for (const Example& example : examples()) {
    const Box box = example.outside->bounds();
    Box sampled;
    for (const Vec3& x : example.sample)
      sampled.add(x);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(box.low[i], sampled.low[i] + rounding);
      EXPECT_GE(box.high[i], sampled.high[i] - rounding);
      if (std::isfinite(box.low[i])) {
        EXPECT_GE(box.low[i], sampled.low[i] - example.spacing) << example.name;
      }
      if (std::isfinite(box.high[i])) {
        EXPECT_LE(box.high[i], sampled.high[i] + example.spacing) << example.name;
      }
    }
  }
  const Box bar = make_cylinder({1, 2, 3}, {0, 0, 1}, 0.5, false)->bounds();
  EXPECT_EQ(bar.low.head<2>(), Vec2(0.5, 1.5));
  EXPECT_TRUE(std::isinf(bar.high.z()));
  EXPECT_EQ(make_cone({1, 2, 3}, {0, 1, 0}, 0.5, false)->bounds().low.y(), 2.0);
}

TEST(AnalyticSurfaces, DrawnTrianglesLieNearTheSurfaceAndFaceOutwards) {
  Box window;
  window.add(Vec3::Constant(-3.0));
  window.add(Vec3::Constant(3.0));
  std::vector<SurfacePtr> surfaces;
  for (Example& example : examples()) {
    surfaces.push_back(std::move(example.outside));
    surfaces.push_back(std::move(example.inside));
  }
  surfaces.push_back(make_plane(origin, tilt));
  for (const SurfacePtr& surface : surfaces) {
    const DisplayMesh drawn = surface->display(window, false);
    EXPECT_GT(drawn.triangles.size(), 1U);
    for (const Vec3& x : drawn.points)
      EXPECT_NEAR(projection(*surface, x).gap, 0.0, rounding * 10);
    for (const auto& t : drawn.triangles) {
      const Vec3 a = drawn.points.at(static_cast<std::size_t>(t[0]));
      const Vec3 b = drawn.points.at(static_cast<std::size_t>(t[1]));
      const Vec3 c = drawn.points.at(static_cast<std::size_t>(t[2]));
      const Vec3 area = (b - a).cross(c - a);
      EXPECT_GT(area.norm(), 0.0);
      EXPECT_GT(area.normalized().dot(projection(*surface, (a + b + c) / 3.0).normal), 0.9);
    }
  }
}

TEST(AnalyticSurfaces, DrawnSectionsLieOnTheSurfaceInThePlane) {
  Box window;
  window.add({-3, -3, 0});
  window.add({3, 3, 0});
  std::vector<SurfacePtr> surfaces;
  surfaces.push_back(make_circle({0.2, 0.1, 0.0}, 1.5, false));
  surfaces.push_back(make_plane({0, 1, 0}, {1, 2, 0}));
  surfaces.push_back(make_cone({0, 1, 0}, {1, 2, 0}, 0.5, false));
  surfaces.push_back(make_cylinder({0, 1, 0}, {0, 2, 0}, 0.5, false));
  surfaces.push_back(make_cylinder({0, 1, 0}, {0, 0, 2}, 0.5, false));
  surfaces.push_back(make_sphere({0, 1, 0}, 0.5, false));
  surfaces.push_back(make_torus({0, 1, 0}, {0, 1, 0}, 1.5, 0.4, false));
  surfaces.push_back(make_torus({0, 1, 0}, {0, 0, 1}, 1.5, 0.4, false));
  for (const SurfacePtr& surface : surfaces) {
    const DisplayMesh drawn = surface->display(window, true);
    EXPECT_FALSE(drawn.lines.empty());
    EXPECT_TRUE(drawn.triangles.empty());
    for (const Vec3& x : drawn.points) {
      EXPECT_EQ(x.z(), 0.0);
      EXPECT_NEAR(projection(*surface, x).gap, 0.0, 1e-2); // a crossing of a drawn chord
    }
    for (const auto& line : drawn.lines)
      EXPECT_LT(static_cast<std::size_t>(std::max(line[0], line[1])), drawn.points.size());
  }
}

TEST(AnalyticSurfaces, GapsScaleWithTheUnitOfLength) {
  // The same scene in metres: gaps shrink and curvatures grow by the factor.
  for (const double unit : {1e-3, 1e-6, 1e6}) {
    const SurfacePtr big = make_torus(origin, tilt, 1.9, 0.6, false);
    const SurfacePtr small = make_torus(unit * origin, tilt, unit * 1.9, unit * 0.6, false);
    for (const Vec3& x : random_points(50, 3.0)) {
      const Projection p = projection(*big, x), q = projection(*small, unit * x, unit * far);
      EXPECT_NEAR(q.gap / unit, p.gap, rounding);
      EXPECT_NEAR((q.normal - p.normal).norm(), 0.0, 1e-10); // near the axis directions amplify
      EXPECT_NEAR((q.dnormal_dx * unit - p.dnormal_dx).norm(), 0.0,
                  1e-8 * (1.0 + p.dnormal_dx.squaredNorm()));
    }
  }
}

TEST(AnalyticSurfaces, ValuesOutOfRangeAreRefused) {
  const Vec3 zero = Vec3::Zero(), nan = Vec3::Constant(std::nan(""));
  EXPECT_THROW((void)make_plane(zero, zero), Error);
  EXPECT_THROW((void)make_plane(nan, Vec3::UnitX()), Error);
  EXPECT_THROW((void)make_circle(zero, 0.0, false), Error);
  EXPECT_THROW((void)make_cylinder(zero, zero, 1.0, false), Error);
  EXPECT_THROW((void)make_sphere(zero, -1.0, false), Error);
  EXPECT_THROW((void)make_sphere(zero, std::nan(""), false), Error);
  EXPECT_THROW((void)make_cone(zero, Vec3::UnitX(), 0.5 * pi, false), Error);
  EXPECT_THROW((void)make_torus(zero, Vec3::UnitX(), 1.0, 1.0, false), Error);
  EXPECT_NO_THROW((void)make_plane(zero, 1e-200 * Vec3::UnitX()));
  EXPECT_EQ(projection(*make_plane(zero, 1e-200 * Vec3::UnitX()), {2, 0, 0}).gap, 2.0);
}

TEST(AnalyticSurfaces, LargeOnesLeaveGapsTheirDigits) {
  // Beneath the origin; distances from the middle are known to 1e-9 only, gaps to 1e-14.
  constexpr double R = 1e7;
  Profile arc; // a flat piece of the circle
  arc.start = {10.0, 0.0};
  arc.segments = {{Vec2(-10.0, 0.0), R}};
  std::vector<std::pair<std::string, SurfacePtr>> large;
  large.emplace_back("circle", make_circle({0, -R, 0}, R, false));
  large.emplace_back("cylinder", make_cylinder({0, -R, 0}, Vec3::UnitZ(), R, false));
  large.emplace_back("sphere", make_sphere({0, -R, 0}, R, false));
  large.emplace_back("torus", make_torus({0, -R - 10.0, 0}, Vec3::UnitZ(), R, 10.0, false));
  large.emplace_back("arc", make_profile(arc));
  for (const auto& [name, surface] : large) {
    double offset = 0.0; // how high its top is, known to the digits of its middle
    double worst = 0.0;
    for (int i = 0; i <= 40; ++i) {
      const double x = 0.05 * i - 1.0, y = 1e-7 * i;
      const double gap = projection(*surface, Vec3(x, y, 0.0)).gap;
      const double expected = y + 0.5 * x * x / R;
      if (i == 0)
        offset = gap - expected;
      worst = std::max(worst, std::abs(gap - expected - offset));
    }
    std::printf("  %s: %.1e off\n", name.c_str(), worst);
    EXPECT_LT(worst, 1e-11) << name; // an arc knows its middle to 1e-5 along it
    EXPECT_LT(std::abs(offset), 1e-5) << name;
  }
}

} // namespace
} // namespace billet::geometry::analytic_surfaces_test
