#include "geometry/collision/narrow_parts.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/revolved_profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace billet::geometry::narrow_parts_test {
namespace {

/// A box of side 2 about the origin, and a width.
NarrowSearch around_origin(double width) {
  return {{Vec3::Constant(-1.0), Vec3::Constant(1.0)}, width};
}

/// No ball stands out of its tool.
void expect_inside(const RigidSurface& tool, const std::vector<InnerBall>& balls) {
  constexpr double rounding = 1e-12;
  for (const InnerBall& ball : balls) {
    Projection foot;
    tool.project({&ball.centre, 1}, 100.0, {&foot, 1});
    ASSERT_TRUE(foot.found());
    EXPECT_LE(foot.gap, -ball.radius + rounding) << ball.centre.transpose();
  }
}

/// Largest distance of a place from the nearest ball's centre.
double farthest(const std::vector<Vec3>& places, const std::vector<InnerBall>& balls) {
  double most = 0.0;
  for (const Vec3& place : places) {
    double nearest = HUGE_VAL;
    for (const InnerBall& ball : balls)
      nearest = std::min(nearest, (ball.centre - place).norm());
    most = std::max(most, nearest);
  }
  return most;
}

TEST(NarrowParts, ASmallBallIsItsOwnAndALargeOneHasNone) {
  const SurfacePtr ball = make_sphere(Vec3(0.1, 0.2, 0.3), 0.05, false);
  const auto found = ball->narrow_parts(around_origin(0.5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].centre, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(found[0].radius, 0.05);
  EXPECT_TRUE(ball->narrow_parts(around_origin(0.04)).empty());
  EXPECT_TRUE(make_sphere(Vec3::Zero(), 0.05, true)->narrow_parts(around_origin(0.5)).empty())
      << "a hollow has no narrow part";
  EXPECT_TRUE(make_plane(Vec3::Zero(), Vec3::UnitZ())->narrow_parts(around_origin(0.5)).empty());
}

TEST(NarrowParts, ABarIsMarkedAlongItsAxisWhereThePartIs) {
  const Vec3 axis = Vec3(1, 2, -2) / 3.0;
  const SurfacePtr bar = make_cylinder(Vec3(0.1, 0, 0), 5.0 * axis, 0.02, false);
  const auto found = bar->narrow_parts(around_origin(0.4));
  expect_inside(*bar, found);
  std::vector<Vec3> places;
  for (double h = -1.0; h <= 1.0; h += 0.01)
    places.push_back(Vec3(0.1, 0, 0) + h * axis);
  EXPECT_LE(farthest(places, found), 0.5 * 0.1 * 1.001);
}

TEST(NarrowParts, AConeIsMarkedFromItsApexToWhereItIsWide) {
  constexpr double half_angle = 0.1;
  const SurfacePtr cone = make_cone(Vec3(0, 0, -0.5), Vec3::UnitZ(), half_angle, false);
  const auto found = cone->narrow_parts(around_origin(0.05));
  expect_inside(*cone, found);
  EXPECT_EQ(found.front().centre, Vec3(0, 0, -0.5));
  EXPECT_EQ(found.front().radius, 0.0);
  EXPECT_NEAR(found.back().radius, 0.05, 1e-12);
  EXPECT_NEAR(found.back().centre.z(), -0.5 + 0.05 / std::sin(half_angle), 1e-12);
}

TEST(NarrowParts, ARingIsMarkedNearThePartOnly) {
  const SurfacePtr ring = make_torus(Vec3(-1000, 0, 0), Vec3::UnitY(), 1000.0, 0.02, false);
  const auto found = ring->narrow_parts(around_origin(0.4));
  expect_inside(*ring, found);
  EXPECT_LT(found.size(), 50u) << "of a ring that is a thousand times as large as the part";
  std::vector<Vec3> places;
  for (double a = -0.001; a <= 0.001; a += 1e-5)
    places.emplace_back(-1000.0 + 1000.0 * std::cos(a), 0.0, 1000.0 * std::sin(a));
  EXPECT_LE(farthest(places, found), 0.5 * 0.1 * 1.001);
}

TEST(NarrowParts, ProfilesAndTurnedOnesHaveTheirCorners) {
  const Profile nail = polygon(
      std::vector<Vec2>{{-0.1, 1.0}, {-0.1, 0.0}, {0.0, -0.1}, {0.1, 0.0}, {0.1, 1.0}}, false);
  const auto corners = make_profile(nail)->narrow_parts(around_origin(0.5));
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_EQ(corners[1].centre, Vec3(0, -0.1, 0));
  // The same nail turned about y: its shoulder is a circle, its tip a point.
  const Profile half = polygon(std::vector<Vec2>{{1.0, 0.1}, {0.0, 0.1}, {-0.1, 0.0}}, false);
  const SurfacePtr turned = make_revolved_profile(Vec3::Zero(), Vec3::UnitY(), half);
  const auto found = turned->narrow_parts(around_origin(0.2));
  expect_inside(*turned, found);
  EXPECT_EQ(std::count_if(found.begin(), found.end(),
                          [](const InnerBall& ball) { return ball.centre == Vec3(0, -0.1, 0); }),
            1);
  std::vector<Vec3> shoulder;
  for (double a = 0.0; a < 2.0 * std::numbers::pi; a += 0.01)
    shoulder.emplace_back(0.1 * std::cos(a), 0.0, 0.1 * std::sin(a));
  EXPECT_LE(farthest(shoulder, found), 0.5 * 0.05 * 1.001);
}

TEST(NarrowParts, EdgesOfFacetsAreMarkedWhereTheyAreSharpOrTightlyRound) {
  const auto edges = narrow_parts(cube(), around_origin(0.4));
  std::vector<Vec3> along;
  for (double t = 0.0; t <= 1.0; t += 0.01)
    along.insert(along.end(), {Vec3(t, 0, 0), Vec3(1, t, 0), Vec3(1, 1, t), Vec3(0, t, 1)});
  EXPECT_LE(farthest(along, edges), 0.5 * 0.1 * 1.001);
  const TriangleMesh ball = sphere_mesh(32); // of radius 1
  EXPECT_TRUE(narrow_parts(ball, around_origin(0.1)).empty()) << "round beside that width";
  EXPECT_GE(narrow_parts(ball, around_origin(10.0)).size(), ball.points.size());
}

/// However large the tool is, there are no more than the window has room for.
TEST(NarrowParts, EdgesOfFacetsAreMarkedInTheWindowOnly) {
  TriangleMesh large = cube(); // from 0 to 1, now to 1e9
  for (Vec3& point : large.points)
    point *= 1e9;
  const NarrowSearch search = around_origin(0.4);
  const auto edges = narrow_parts(large, search);
  std::vector<Vec3> along;
  for (double t = 0.0; t <= 1.0; t += 0.01)
    along.insert(along.end(), {Vec3(t, 0, 0), Vec3(0, t, 0), Vec3(0, 0, t)});
  EXPECT_LE(farthest(along, edges), 0.5 * search.step() * 1.001);
  EXPECT_LE(edges.size(), 40U);
  for (const InnerBall& ball : edges)
    EXPECT_LE(ball.centre.cwiseAbs().maxCoeff(), 1.0 + search.step() * 1.001);
}

TEST(NarrowParts, HollowEdgesAndRimsHaveNone) {
  for (const InnerBall& ball : narrow_parts(flipped(cube()), around_origin(0.4)))
    ADD_FAILURE() << "in a cavity at " << ball.centre.transpose();
  const TriangleMesh flat = sheet(4, [](double, double) { return 0.0; });
  EXPECT_TRUE(narrow_parts(flat, around_origin(0.4)).empty());
}

} // namespace
} // namespace billet::geometry::narrow_parts_test
