#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/triangle_surface.h"
#include "process/setup/tool_meetings.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace billet::process::tool_meetings_test {
namespace {

using geometry::Motion;

Scene scene_with(Analysis analysis, std::vector<contact::Tool> tools, double end) {
  Scene scene;
  scene.part.analysis = analysis;
  const bool solid = analysis == Analysis::solid;
  scene.part.mesh = mechanics::box_mesh({solid ? ElementKind::hex8 : ElementKind::quad4,
                                         Vec3::Zero(),
                                         Vec3(1, 1, solid ? 1 : 0),
                                         {1, 1, 1},
                                         {1, 1, 1}});
  scene.material = elastic_body(1.0, 0.3);
  scene.stages.push_back({"press", end, std::vector<char>(tools.size(), 1), false});
  scene.touch.assign(tools.size(), 0);
  scene.tools = std::move(tools);
  return scene;
}

contact::Tool tool(geometry::SurfacePtr surface, const Vec3& velocity = Vec3::Zero()) {
  return moving_tool("tool", std::move(surface), velocity);
}

std::vector<contact::Tool> two(contact::Tool a, contact::Tool b) {
  std::vector<contact::Tool> tools;
  tools.push_back(std::move(a));
  tools.push_back(std::move(b));
  return tools;
}

geometry::SurfacePtr block(const Vec3& low, const Vec3& high) {
  geometry::TriangleMesh mesh = geometry::cube();
  for (Vec3& p : mesh.points)
    p = low + (high - low).cwiseProduct(p);
  return geometry::make_triangle_surface(mesh);
}

geometry::SurfacePtr rectangle(const Vec2& low, const Vec2& high) {
  const std::vector<Vec2> corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  return geometry::make_profile(geometry::polygon(corners, true));
}

constexpr double precision = 1e-6; // a clearance of 1e-9 of a size of 10, over the slowest closing

void expect_meeting(const Scene& scene, double time) {
  const auto meetings = tool_meetings(scene);
  ASSERT_EQ(meetings.size(), 1u);
  EXPECT_FALSE(meetings[0].from_start);
  EXPECT_EQ(meetings[0].first, 0u);
  EXPECT_EQ(meetings[0].second, 1u);
  EXPECT_NEAR(meetings[0].time, time, precision);
}

TEST(ToolMeetings, FlatDiesMeetWhenTheirGapIsUsedUp) {
  for (const Analysis analysis : {Analysis::solid, Analysis::axisymmetric}) {
    const Vec3 along = Vec3::Unit(up(analysis));
    const auto dies = [&] {
      return two(tool(geometry::make_plane(2.0 * along, -along), -along),
                 tool(geometry::make_plane(Vec3::Zero(), along)));
    };
    expect_meeting(scene_with(analysis, dies(), 3.0), 2.0);
    EXPECT_TRUE(tool_meetings(scene_with(analysis, dies(), 1.9)).empty());
  }
}

TEST(ToolMeetings, BlocksOfTrianglesMeetFaceOnEdgeAcrossEdgeAndAtAPlane) {
  const Vec3 down(0, 0, -1);
  expect_meeting(scene_with(Analysis::solid,
                            two(tool(block({-1, -1, 3}, {2, 2, 4}), down),
                                tool(block({-2, 0, -1}, {3, 1, 0.5}))),
                            4.0),
                 2.5);
  // Two long bars turned on edge, one across the other: no corner of one is ever in the other.
  const auto bar = [](double height, bool across) {
    geometry::TriangleMesh mesh = geometry::cube();
    for (Vec3& p : mesh.points) {
      p = Vec3(10, 1, 1).cwiseProduct(p - Vec3::Constant(0.5));
      p = geometry::rotation_about(Vec3::Zero(), Vec3::UnitX(), std::numbers::pi / 4).to_space(p);
      if (across)
        p = Vec3(-p.y(), p.x(), p.z());
      p.z() += height;
    }
    return geometry::make_triangle_surface(mesh);
  };
  expect_meeting(
      scene_with(Analysis::solid, two(tool(bar(4.0, false), down), tool(bar(0.0, true))), 4.0),
      4.0 - std::sqrt(2.0));
  expect_meeting(scene_with(Analysis::solid,
                            two(tool(bar(4.0, false), down),
                                tool(geometry::make_plane(Vec3::Zero(), Vec3::UnitZ()))),
                            4.0),
                 4.0 - std::sqrt(0.5));
}

TEST(ToolMeetings, ProfilesAndRollsMeetInThePlane) {
  expect_meeting(scene_with(Analysis::plane_strain,
                            two(tool(rectangle({0, 3}, {1, 4}), {0, -1, 0}),
                                tool(rectangle({-5, -1}, {5, 0.5}))),
                            4.0),
                 2.5);
  // Circles are drawn in 512 chords: they meet late by at most their sagittas, 2 x 1.9e-5.
  const auto meetings =
      tool_meetings(scene_with(Analysis::plane_strain,
                               two(tool(geometry::make_circle({0, 3, 0}, 1.0, false), {0, -1, 0}),
                                   tool(geometry::make_circle({0, 0, 0}, 1.0, false))),
                               4.0));
  ASSERT_EQ(meetings.size(), 1u);
  EXPECT_NEAR(meetings[0].time, 1.0, 4e-5);
  EXPECT_NEAR(meetings[0].place.y(), 1.0, 0.1);
}

TEST(ToolMeetings, ATurningBladeMeetsAnAnvilAtItsAngle) {
  // From upright to level: its lower corner, at radius sqrt(4 + 0.01) below the level, comes down.
  contact::Tool blade = tool(rectangle({0, -0.1}, {2, 0.1}));
  blade.motion = {};
  blade.motion.rotation = geometry::Rotation{Vec3::Zero(), -Vec3::UnitZ(), 1.0};
  const double radius = std::hypot(2.0, 0.1), below = std::atan2(0.1, 2.0);
  expect_meeting(scene_with(Analysis::plane_strain,
                            two(std::move(blade), tool(rectangle({1, -3}, {3, -1}))), 2.0),
                 std::asin(1.0 / radius) - below);
}

TEST(ToolMeetings, WhatIsMeantIsNotTold) {
  const auto quiet = [](Analysis analysis, contact::Tool a, contact::Tool b) {
    return tool_meetings(scene_with(analysis, two(std::move(a), std::move(b)), 2.0)).empty();
  };
  EXPECT_TRUE(quiet(Analysis::solid, tool(geometry::make_plane({0, 0, 2}, {0, 0, -1}), {0, 0, -1}),
                    tool(geometry::make_plane({-1, 0, 0}, {1, 0, 0}))))
      << "the corner of a container";
  EXPECT_TRUE(quiet(Analysis::solid, tool(block({0, 0, 2}, {1, 1, 3}), {0, 0, -1}),
                    tool(block({1, 0, -5}, {2, 1, 5}))))
      << "a punch that glides along a wall";
  EXPECT_TRUE(quiet(Analysis::solid, tool(geometry::make_plane({0, 0, 2}, {0, 0, -1}), {0, 0, -1}),
                    tool(geometry::make_cylinder({0, 0, 0}, {0, 0, 1}, 2.0, true))))
      << "a flat punch in a bore";
  EXPECT_TRUE(quiet(Analysis::axisymmetric, tool(rectangle({0, 2}, {1, 3}), {0, -1, 0}),
                    tool(rectangle({1, -5}, {2, 5}))));
}

TEST(ToolMeetings, BoundedToolsThatOverlapFromTheStartAreTold) {
  const auto meetings = tool_meetings(scene_with(
      Analysis::solid,
      two(tool(block({0, 0, 0.8}, {1, 1, 2})), tool(block({-1, -1, 0}, {2, 2, 1}))), 1.0));
  ASSERT_EQ(meetings.size(), 1u);
  EXPECT_TRUE(meetings[0].from_start);
  EXPECT_EQ(meetings[0].time, 0.0);
  EXPECT_NEAR(meetings[0].depth, 0.2, 1e-9);
  // Swallowed whole: no facet cuts another.
  EXPECT_EQ(tool_meetings(scene_with(Analysis::solid,
                                     two(tool(block({-5, -5, -5}, {5, 5, 5})),
                                         tool(block({-1, -1, -1}, {1, 1, 1}))),
                                     1.0))
                .size(),
            1u);
}

TEST(ToolMeetings, OnlyWhileBothAct) {
  const auto dies = [] {
    return two(tool(geometry::make_plane({0, 0, 2}, {0, 0, -1}), {0, 0, -1}),
               tool(geometry::make_plane(Vec3::Zero(), {0, 0, 1})));
  };
  Scene gone = scene_with(Analysis::solid, dies(), 3.0);
  gone.tools[1].active_to = 1.5;
  EXPECT_TRUE(tool_meetings(gone).empty());
  Scene stages = scene_with(Analysis::solid, dies(), 1.5);
  stages.stages.push_back({"unload", 3.0, {1, 1}, true});
  EXPECT_TRUE(tool_meetings(stages).empty());
  stages.stages[1].unload = false;
  expect_meeting(stages, 2.0);
}

TEST(ToolMeetings, PunchesOfOneSectionMeet) {
  // No facet of one cuts the other's, and corners only reach its sides.
  expect_meeting(scene_with(Analysis::solid,
                            two(tool(block({0, 0, 2}, {1, 1, 3}), {0, 0, -1}),
                                tool(block({0, 0, -1}, {1, 1, 0.5}))),
                            2.0),
                 1.5);
  expect_meeting(scene_with(Analysis::axisymmetric,
                            two(tool(rectangle({0, 2}, {1, 3}), {0, -1, 0}),
                                tool(rectangle({0, -1}, {1, 0.5}))),
                            2.0),
                 1.5);
}

TEST(ToolMeetings, AToolThatALoadDrivesIsLookedAtWhereItStartsOnly) {
  Scene scene =
      scene_with(Analysis::solid,
                 two(tool(block({0, 0, 1}, {1, 1, 2})), tool(block({0, 0, 1.5}, {1, 1, 3}))), 1.0);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.force = geometry::Drive{Vec3::Zero(), -Vec3::UnitZ(), TimeFunction(1.0)};
  scene.stages = {{"alone", 1.0, {1, 0}, false}, {"both", 2.0, {1, 1}, false}};
  EXPECT_TRUE(tool_meetings(scene).empty()) << "the load has moved it by then";
  scene.stages[0].tools = {0, 1};
  const auto meetings = tool_meetings(scene);
  ASSERT_EQ(meetings.size(), 1u);
  EXPECT_TRUE(meetings[0].from_start);
  EXPECT_EQ(meetings[0].time, 1.0);
}

TEST(ToolMeetings, RandomDiesAgreeWithSmallSteps) {
  // Against brute force: gaps of all corners of one die in the other, both ways, in small steps.
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  int met = 0;
  for (int k = 0; k < 10; ++k) {
    const auto bumpy = [](const Vec3& n) { return 1.0 + 0.15 * n.x() * n.y(); };
    const geometry::TriangleMesh mesh = geometry::star(10, bumpy);
    contact::Tool a = tool(geometry::make_triangle_surface(mesh), {any(generator), 0.1, -1.0});
    a.motion.place.translation = Vec3(any(generator), any(generator), 3.0);
    a.motion.rotation = geometry::Rotation{Vec3::Zero(), Vec3::UnitX(), any(generator)};
    contact::Tool b = tool(geometry::make_triangle_surface(mesh));
    const Scene scene = scene_with(Analysis::solid, two(std::move(a), std::move(b)), 3.0);
    const auto deepest = [&](double time) {
      double least = 1.0;
      for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, 0)}) {
        const Motion &here = scene.tools[as_size(from)].motion,
                     &there = scene.tools[as_size(to)].motion;
        for (const Vec3& p : mesh.points) {
          const Vec3 x = there.pose(time).to_tool(here.pose(time).to_space(p));
          geometry::Projection foot;
          scene.tools[as_size(to)].surface->project({&x, 1}, 10.0, {&foot, 1});
          least = std::min(least, foot.gap);
        }
      }
      return -least;
    };
    constexpr double step = 0.01;
    double brute = 0.0;
    while (brute < 3.0 && deepest(brute) <= 0.0)
      brute += step;
    const auto meetings = tool_meetings(scene);
    if (brute >= 3.0)
      continue; // they pass each other
    ++met;
    ASSERT_EQ(meetings.size(), 1u) << k;
    // Corners are the later to meet, by what facets of 0.3 sink into each other edge on edge.
    EXPECT_LE(meetings[0].time, brute) << k;
    EXPECT_GE(meetings[0].time, brute - step - 0.05) << k;
  }
  EXPECT_GE(met, 5);
}

TEST(ToolMeetings, AreFoundWhereALoadHasTakenATool) {
  // A holder 2 above a die; the load takes it through the die's face, or not as far.
  contact::Tool holder = tool(rectangle({0, 2}, {3, 3}));
  holder.motion.velocity.reset();
  holder.motion.force = geometry::Drive{Vec3::Zero(), -Vec3::UnitY(), TimeFunction({{0.0, 1e3}})};
  const Scene scene = scene_with(Analysis::plane_strain,
                                 two(tool(rectangle({-1, -1}, {2, 0})), std::move(holder)), 1.0);
  EXPECT_TRUE(tool_meetings(scene).empty()) << "nobody knows where it goes";
  for (const auto& [travel, depth] : {std::pair{1.9, 0.0}, std::pair{2.3, 0.3}}) {
    const std::vector<geometry::Pose> poses{scene.tools[0].motion.pose(0.5),
                                            scene.tools[1].motion.pose(0.5, {.travel = travel})};
    const auto overlaps = overlaps_by_loads(scene, 0.5, poses);
    ASSERT_EQ(overlaps.size(), depth > 0.0 ? 1u : 0u) << travel;
    if (depth > 0.0) {
      EXPECT_NEAR(overlaps[0].depth, depth, 1e-9);
      EXPECT_EQ(overlaps[0].second, 1u);
    }
  }
}

} // namespace
} // namespace billet::process::tool_meetings_test
