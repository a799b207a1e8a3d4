#include "geometry/base/error.h"
#include "geometry/surfaces/profile.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

namespace billet::geometry::profile_test {
namespace {

constexpr double rounding = 1e-12; // coordinates up to 10
constexpr double pi = std::numbers::pi;

Vec3 flat(const Vec2& x) { return {x.x(), x.y(), 0.0}; }

// A punch with a concave corner, a fillet, a bulge of more than half a turn and a nose.
Profile punch() {
  Profile p;
  p.start = {0, 0};
  p.segments = {{{2, 0}},
                {{3, 1}, 1.0}, // quarter turn left: convex fillet
                {{3, 2}},
                {{2.5, 2.5}, -0.5},      // quarter turn right: concave fillet
                {{2.5, 3.5}, 0.6, true}, // a bulb
                {{1, 3}},
                {{1, 2}},
                {{-1, 2}}};
  p.closed = true;
  return p;
}

// Winding number of a polygon: independent of distances.
bool inside(const std::vector<Vec2>& polygon, const Vec2& x) {
  double turn = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 u = polygon[i] - x, v = polygon[(i + 1) % polygon.size()] - x;
    turn += std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
  }
  return std::abs(turn) > pi;
}

double distance(const std::vector<Vec2>& polygon, const Vec2& x) {
  double least = far;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], way = polygon[(i + 1) % polygon.size()] - a;
    const double t = std::clamp((x - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (x - a - t * way).norm());
  }
  return least;
}

TEST(Profile, GapIsTheSignedDistanceToAFinePolygon) {
  const SurfacePtr surface = make_profile(punch());
  const std::vector<Vec2> polygon = polyline(punch(), 1e-3);
  constexpr double sagitta = 1.0 * 1e-6 / 8; // radius angle^2 / 8
  for (const Vec3& x : random_points(2000, 5.0, true)) {
    const double gap = projection(*surface, x).gap;
    const double expected = distance(polygon, x.head<2>());
    EXPECT_NEAR(std::abs(gap), expected, 2 * sagitta);
    if (expected > sagitta) {
      EXPECT_EQ(gap < 0.0, inside(polygon, x.head<2>())) << x.transpose();
    }
  }
}

TEST(Profile, NormalIsTheGradientOfTheGapAndDnormalDxItsDerivative) {
  const SurfacePtr surface = make_profile(punch());
  int checked = 0;
  for (const Vec3& x : random_points(1000, 5.0, true)) {
    expect_consistent(*surface, x);
    checked += expect_derivatives(*surface, x, true) ? 1 : 0;
    EXPECT_EQ(projection(*surface, x).normal.z(), 0.0);
  }
  EXPECT_GT(checked, 950);
}

TEST(Profile, RunTheOtherWayTheToolIsOutside) {
  const SurfacePtr solid = make_profile(punch()), container = make_profile(reversed(punch()));
  for (const Vec3& x : random_points(500, 5.0, true)) {
    const Projection p = projection(*solid, x), q = projection(*container, x);
    EXPECT_NEAR(p.gap, -q.gap, rounding);
    EXPECT_NEAR((p.normal + q.normal).norm(), 0.0, 1e-9); // close to a corner directions amplify
  }
}

TEST(Profile, ASquareIsRightAtItsCorners) {
  const std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const SurfacePtr square = make_profile(polygon(corners, true));
  const Projection corner = projection(*square, {1.3, 1.4, 0});
  EXPECT_NEAR(corner.gap, 0.5, rounding);
  EXPECT_NEAR((corner.normal - Vec3(0.6, 0.8, 0)).norm(), 0.0, rounding);
  EXPECT_NEAR(corner.dnormal_dx.trace(), 1.0 / 0.5, rounding);
  const Projection in = projection(*square, {0.9, 0.6, 0});
  EXPECT_NEAR(in.gap, -0.1, rounding);
  EXPECT_NEAR((in.normal - Vec3(1, 0, 0)).norm(), 0.0, rounding);
  const Projection at = projection(*square, {1, 1, 0});
  EXPECT_EQ(at.gap, 0.0);
  EXPECT_NEAR((at.normal - Vec3(1, 1, 0).normalized()).norm(), 0.0, rounding);
  EXPECT_NEAR(projection(*square, {0.5, 0.5, 0}).gap, -0.5, rounding);
}

TEST(Profile, BehindAConcaveCornerTheNormalPointsAtTheCorner) {
  // A notch: the tool fills three quadrants.
  const std::vector<Vec2> corners{{5, 0}, {0, 0}, {0, 5}};
  const SurfacePtr notch = make_profile(polygon({corners}, false));
  // Walking left along y = 0 the tool is below; then up along x = 0 the tool is at x < 0.
  EXPECT_NEAR(projection(*notch, {1, 2, 0}).gap, 1.0, rounding);
  EXPECT_NEAR(projection(*notch, {2, 1, 0}).gap, 1.0, rounding);
  const Projection deep = projection(*notch, {-0.3, -0.4, 0});
  EXPECT_NEAR(deep.gap, -0.5, rounding);
  EXPECT_NEAR((deep.normal - Vec3(0.6, 0.8, 0)).norm(), 0.0, rounding);
  expect_derivatives(*notch, {-0.3, -0.4, 0}, true);
}

TEST(Profile, BeyondTheRimOfAnOpenProfileOnlyTheFrontIsFound) {
  const std::vector<Vec2> points{{3, 0}, {0, 0}}; // walking left: tool below, front above
  const SurfacePtr sheet = make_profile(polygon(points, false));
  EXPECT_NEAR(projection(*sheet, {1, 2, 0}).gap, 2.0, rounding);
  EXPECT_NEAR(projection(*sheet, {1, -2, 0}).gap, -2.0, rounding);
  const Projection front = projection(*sheet, {-0.3, 0.4, 0});
  EXPECT_NEAR(front.gap, 0.5, rounding);
  EXPECT_NEAR((front.normal - Vec3(-0.6, 0.8, 0)).norm(), 0.0, rounding);
  EXPECT_FALSE(projection(*sheet, {-0.3, -0.4, 0}).found());
  EXPECT_FALSE(projection(*sheet, {3.3, -0.4, 0}).found());
  EXPECT_NEAR(projection(*sheet, {3.5, 0, 0}).gap, 0.5, rounding);
}

TEST(Profile, APointOnTheSymmetryAxisStillSeesAProfileThatStartsThere) {
  const std::vector<Vec2> points{{3, 0}, {0, 0}};
  const SurfacePtr sheet = make_profile(polygon(points, false));
  for (const double x : {0.0, 1e-17, -1e-17, -1e-10}) {
    const Projection p = projection(*sheet, {x, -1e-3, 0});
    EXPECT_NEAR(p.gap, -1e-3, rounding);
    EXPECT_NEAR((p.normal - Vec3(0, 1, 0)).norm(), 0.0, rounding);
  }
}

TEST(Profile, TwoHalfCirclesAreACircle) {
  Profile p;
  p.start = {1, 0};
  p.segments = {{{-1, 0}, 1.0}, {{1, 0}, 1.0}};
  p.closed = true;
  const SurfacePtr circle = make_profile(p);
  for (const Vec3& x : random_points(500, 3.0, true)) {
    const Projection q = projection(*circle, x);
    EXPECT_NEAR(q.gap, x.norm() - 1.0, rounding);
    EXPECT_NEAR((q.normal - x.normalized()).norm(), 0.0, 1e-10);
  }
  const Projection centre = projection(*circle, Vec3::Zero());
  EXPECT_NEAR(centre.gap, -1.0, rounding);
  EXPECT_NEAR(centre.normal.norm(), 1.0, rounding);
  EXPECT_TRUE(centre.dnormal_dx.allFinite());
}

TEST(Profile, AnAlmostStraightArcIsAlmostALine) {
  Profile p;
  p.start = {1, 0};
  p.segments = {{{0, 0}, 1e6}}; // turning left: centre below, in the tool
  const SurfacePtr arc = make_profile(p);
  constexpr double cancellation = 1e-9; // eps times the radius
  EXPECT_NEAR(projection(*arc, {0.5, 0.2, 0}).gap, 0.2 - 0.125e-6, cancellation);
  EXPECT_NEAR(projection(*arc, {0.5, -0.2, 0}).gap, -0.2 - 0.125e-6, cancellation);
}

TEST(Profile, TheResultDoesNotDependOnTheHint) {
  std::vector<Vec2> wavy;
  for (int i = 0; i < 200; ++i)
    wavy.emplace_back(5.0 - 0.05 * i, 0.3 * std::sin(0.4 * i));
  for (const Profile& profile : {punch(), polygon(wavy, false)}) {
    const SurfacePtr surface = make_profile(profile);
    std::vector<Vec3> points = random_points(300, 5.0, true);
    for (double x = -2; x <= 3; x += 0.125) // ties on axes of symmetry
      points.push_back({x, 1.0, 0.0});
    for (const Vec3& x : points) {
      const Projection p = projection(*surface, x);
      for (std::int32_t hint = 0; hint < 220; hint += 3)
        EXPECT_TRUE(same_bits(p, projection(*surface, x, far, hint)));
    }
  }
}

TEST(Profile, ManyThreadsGiveTheSameBits) {
  const SurfacePtr surface = make_profile(punch());
  const std::vector<Vec3> points = random_points(2000, 5.0, true);
  std::vector<std::vector<Projection>> results(4, std::vector<Projection>(points.size()));
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&] { surface->project(points, far, result); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto& result : results)
      EXPECT_TRUE(same_bits(result[i], results[0][i]));
}

TEST(Profile, PointsBeyondReachAreNotFound) {
  const SurfacePtr surface = make_profile(punch());
  for (const Vec3& x : random_points(200, 5.0, true)) {
    const double gap = std::abs(projection(*surface, x).gap);
    EXPECT_FALSE(projection(*surface, x, 0.999 * gap).found());
    EXPECT_TRUE(same_bits(projection(*surface, x, 1.001 * gap), projection(*surface, x)));
  }
}

TEST(Profile, BoundsAndDrawingFollowTheArcs) {
  const SurfacePtr surface = make_profile(punch());
  Box sampled;
  for (const Vec2& x : polyline(punch(), 1e-3))
    sampled.add(flat(x));
  EXPECT_NEAR((surface->bounds().low - sampled.low).norm(), 0.0, 1e-6);
  EXPECT_NEAR((surface->bounds().high - sampled.high).norm(), 0.0, 1e-6);
  const DisplayMesh drawn = surface->display({}, true);
  EXPECT_EQ(drawn.lines.size(), drawn.points.size()); // closed
  for (const Vec3& x : drawn.points)
    EXPECT_NEAR(projection(*surface, x).gap, 0.0, rounding);
}

TEST(Profile, UnsoundChainsAreRefused) {
  const auto complain = [](const Profile& p) { return flaws(p).size(); };
  const std::vector<Vec2> bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  EXPECT_EQ(complain(polygon(bow, true)), 1U);
  EXPECT_THROW((void)make_profile(polygon(bow, true)), Error);
  const std::vector<Vec2> fold{{0, 0}, {1, 0}, {0.5, 0}};
  EXPECT_GE(complain(polygon(fold, false)), 1U);
  const std::vector<Vec2> twice{{0, 0}, {0, 0}, {1, 0}};
  EXPECT_EQ(complain(polygon(twice, false)), 1U);
  const std::vector<Vec2> touching{{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}};
  EXPECT_GE(complain(polygon(touching, true)), 1U);
  const std::vector<Vec2> shut{{0, 0}, {1, 0}, {1, 1}, {0, 0}};
  EXPECT_EQ(complain(polygon(shut, false)), 1U);
  EXPECT_EQ(complain(polygon(shut, true)), 0U);
  EXPECT_EQ(complain(Profile{}), 1U);
  Profile crossing; // an arc through a line
  crossing.start = {0, 0};
  crossing.segments = {{{4, 0}}, {{4, 2}}, {{1, 1}}, {{3, 1}, 1.2, true}};
  EXPECT_GE(complain(crossing), 1U);
  EXPECT_EQ(complain(punch()), 0U);
}

TEST(Profile, ARadiusTooSmallForItsChordIsRefusedButRoundingIsNot) {
  EXPECT_TRUE(flaw({0, 0}, {{2, 0}, 0.99}).has_value());
  EXPECT_FALSE(flaw({0, 0}, {{2, 0}, 1.0 - 1e-12}).has_value());
  EXPECT_TRUE(flaw({0, 0}, {{2, 0}, 0.0, true}).has_value());
  EXPECT_TRUE(flaw({0, 0}, {{2, std::nan("")}}).has_value());
}

TEST(Profile, CornersAreThoseThatPointOutOfTheTool) {
  // A notch and a point that turn by a right angle, a kink of 5 degrees, a rounding of half a turn.
  Profile p;
  p.start = {0, 0};
  p.segments = {{{4, 0}},
                {{4, 2}},                                       // a point at (4, 0)
                {{6, 2}},                                       // a notch at (4, 2)
                {{6, 4}, 1.0},                                  // half a turn about (6, 3)
                {{2, 4}},                                       // points at both of its ends: none
                {{0, 4.0 - 2.0 * std::tan(5.0 * pi / 180.0)}}}; // a kink
  p.closed = true;
  constexpr double angle = 10.0 * pi / 180.0;
  const std::vector<ToolCorner> corners = make_profile(p)->corners(angle);
  ASSERT_EQ(corners.size(), 5u);
  EXPECT_TRUE(corners[0].centre.isApprox(Vec3(4, 0, 0)));
  EXPECT_EQ(corners[0].radius, 0.0);
  EXPECT_TRUE(corners[0].from.isApprox(-Vec3::UnitY()));
  EXPECT_TRUE(corners[0].to.isApprox(Vec3::UnitX()));
  for (const std::size_t half : {1, 2}) {
    EXPECT_TRUE(corners[half].centre.isApprox(Vec3(6, 3, 0), 1e-9)) << half;
    EXPECT_EQ(corners[half].radius, 1.0);
  }
  EXPECT_TRUE(corners[1].to.isApprox(Vec3::UnitX())) << "its middle";
  EXPECT_TRUE(corners[2].from.isApprox(corners[1].to));
  EXPECT_TRUE(corners[3].centre.isApprox(Vec3(0, 4.0 - 2.0 * std::tan(5.0 * pi / 180.0), 0)));
  EXPECT_TRUE(corners[4].centre.isApprox(Vec3(0, 0, 0), 1e-12)) << "where it closes";
  EXPECT_EQ(make_profile(p)->corners(4.0 * pi / 180.0).size(), 6u) << "with the kink";
  EXPECT_TRUE(make_profile(reversed(p))->corners(angle).size() == 1u) << "the notch";
}

TEST(Profile, TheClosingLineIsAddedOnlyWhereItIsMissing) {
  const std::vector<Vec2> open{{0, 0}, {1, 0}, {1, 1}}, shut{{0, 0}, {1, 0}, {1, 1}, {1e-14, 0}};
  const SurfacePtr a = make_profile(polygon(open, true)), b = make_profile(polygon(shut, true));
  for (const Vec3& x : random_points(200, 2.0, true))
    EXPECT_TRUE(same_bits(projection(*a, x), projection(*b, x)));
}

} // namespace
} // namespace billet::geometry::profile_test
