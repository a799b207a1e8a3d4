// Loads that are there at once. (P.26)

#include "geometry/surfaces/analytic_surfaces.h"
#include "process/setup/sudden_loads.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace billet::process::sudden_loads_test {
namespace {

/// A scene with stages that end at these times; a tool acts where its flag says so.
Scene scene_of(const std::vector<double>& ends) {
  Scene scene;
  for (const double end : ends)
    scene.stages.push_back({"stage", end, {}, false});
  scene.landing_times = {ends.begin(), ends.end()};
  return scene;
}

void add_press(Scene& scene, TimeFunction load, const std::vector<char>& acts) {
  contact::Tool tool = moving_tool("press", geometry::make_plane({0, 0, 0}, {0, 1, 0}), {0, 0, 0});
  tool.motion.velocity.reset();
  tool.motion.force = geometry::Drive{Vec3::Zero(), Vec3::UnitY(), std::move(load)};
  scene.tools.push_back(std::move(tool));
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    scene.stages[s].tools.push_back(acts[s]);
}

double load(const Scene& scene, std::size_t tool, double time) {
  return scene.tools[tool].motion.force->load(time);
}

bool lands(const Scene& scene, double time) {
  return std::count(scene.landing_times.begin(), scene.landing_times.end(), time) == 1;
}

TEST(SuddenLoads, GrowInIncrementsNoShorterThanMayBe) {
  Scene scene = scene_of({1.0});
  add_press(scene, TimeFunction(100.0), {1});
  scene.increments.min = 0.05;
  grow_sudden_loads(scene);
  EXPECT_DOUBLE_EQ(load(scene, 0, 0.025), 50.0);
  EXPECT_EQ(scene.landing_times, (std::vector<double>{0.05, 1.0}));
}

TEST(SuddenLoads, GrowOverTheFirstIncrementAndAreThenWhatTheyWere) {
  Scene scene = scene_of({1.0});
  add_press(scene, TimeFunction({{0.0, 100.0}, {1.0, 200.0}}), {1});
  scene.part.loads.emplace_back(PressureOn{{}, TimeFunction(5.0)});
  scene.part.loads.emplace_back(DeadForces{{}, TimeFunction({{0.0, 0.0}, {0.001, 7.0}})});
  scene.part.supports.push_back({{}, 0, TimeFunction(-0.3)});
  scene.part.supports.push_back({{}, 1, TimeFunction(0.0)});
  grow_sudden_loads(scene);
  EXPECT_EQ(load(scene, 0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(load(scene, 0, 0.01), 101.0);
  EXPECT_DOUBLE_EQ(load(scene, 0, 0.005), 50.5);
  EXPECT_DOUBLE_EQ(load(scene, 0, 0.5), 150.0);
  EXPECT_DOUBLE_EQ(std::get<PressureOn>(scene.part.loads[0]).pressure(0.0025), 1.25);
  EXPECT_EQ(std::get<PressureOn>(scene.part.loads[0]).pressure(0.7), 5.0);
  EXPECT_EQ(std::get<DeadForces>(scene.part.loads[1]).amplitude(0.0005), 3.5) << "grows by itself";
  EXPECT_DOUBLE_EQ(scene.part.supports[0].displacement(0.005), -0.15);
  EXPECT_EQ(scene.part.supports[0].displacement(1.0), -0.3);
  EXPECT_EQ(scene.part.supports[1].displacement.points().size(), 1U);
  for (const double quarter : {0.0025, 0.005, 0.0075, 0.01})
    EXPECT_TRUE(lands(scene, quarter)) << quarter;
}

TEST(SuddenLoads, GrowNoLongerThanTheCaseLetsTheFirstIncrementBe) {
  const auto whole = [](double first, double landing) {
    Scene scene = scene_of({1.0});
    scene.increments.first = first;
    scene.landing_times.insert(scene.landing_times.begin(), landing);
    add_press(scene, TimeFunction(100.0), {1});
    grow_sudden_loads(scene);
    double time = 0.0;
    while (load(scene, 0, time) < 100.0)
      time += 1e-4;
    return time;
  };
  EXPECT_NEAR(whole(0.2, 0.9), 0.2, 2e-4);
  EXPECT_NEAR(whole(0.002, 0.9), 0.002, 2e-4);
  EXPECT_NEAR(whole(0.2, 0.05), 0.05, 2e-4) << "a landing";
}

TEST(SuddenLoads, OfAToolThatComesBackAreWholeUntilItLeaves) {
  Scene scene = scene_of({1.0, 2.0, 3.0});
  add_press(scene, TimeFunction({{0.0, 0.0}, {0.5, 1500.0}, {4.0, 1500.0}}), {1, 0, 1});
  add_press(scene, TimeFunction(1000.0), {1, 0, 1});
  scene.stages[1].unload = true;
  grow_sudden_loads(scene);
  for (const double time : {0.5, 0.75, 1.0, 2.01, 3.0}) {
    EXPECT_EQ(load(scene, 0, time), 1500.0) << time;
    EXPECT_EQ(load(scene, 1, time), 1000.0) << time;
  }
  EXPECT_EQ(load(scene, 0, 0.25), 750.0);
  EXPECT_EQ(load(scene, 0, 2.0), 0.0);
  EXPECT_NEAR(load(scene, 0, 2.005), 750.0, 1e-9);
  EXPECT_EQ(load(scene, 1, 2.0), 0.0);
}

TEST(SuddenLoads, TakeOverAsTheForcesOfTheToolBeforeFade) {
  Scene scene = scene_of({1.0, 3.0});
  add_press(scene, TimeFunction(1000.0), {1, 0});
  add_press(scene, TimeFunction(1000.0), {0, 1});
  grow_sudden_loads(scene);
  EXPECT_EQ(load(scene, 0, 1.0), 1000.0);
  EXPECT_EQ(load(scene, 1, 1.0), 0.0);
  EXPECT_NEAR(load(scene, 1, 1.05), 500.0, 1e-9); // 5 % of a stage of 2 s
  EXPECT_NEAR(load(scene, 1, 1.1), 1000.0, 1e-9);
}

TEST(SuddenLoads, DoNotGrowWhereAToolJustGoesOn) {
  Scene scene = scene_of({1.0, 2.0});
  add_press(scene, TimeFunction(1000.0), {1, 1});
  grow_sudden_loads(scene);
  for (const double time : {0.01, 0.99, 1.0, 1.001, 2.0})
    EXPECT_EQ(load(scene, 0, time), 1000.0) << time;
}

TEST(SuddenLoads, OfHammersStayWhatTheyAre) {
  Scene scene = scene_of({1.0});
  add_press(scene, TimeFunction(1000.0), {1});
  scene.tools[0].motion.force->blow = geometry::Blow{};
  grow_sudden_loads(scene);
  EXPECT_EQ(load(scene, 0, 0.0), 1000.0);
}

} // namespace
} // namespace billet::process::sudden_loads_test
