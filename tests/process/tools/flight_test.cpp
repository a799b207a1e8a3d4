// Flights: a tool far away, a part carried along, one increment to the touch. (P.31)

#include "process/tools/flight.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace billet::process::flight_test {
namespace {

/// How far forces may be from those of a tool that touches from the start [-].
constexpr double close = 1e-3;

/// A billet in the plane or a bar in space, and a flat die that starts so far above it [mm].
Scene die_above(bool solid, double away, double reduction = 0.05) {
  Upsetting u = bar_upsetting(solid ? ElementKind::hex8 : ElementKind::quad8);
  u.reduction = reduction;
  u.friction = contact::Coulomb{0.1};
  Scene scene = upsetting_scene(std::move(u));
  const Vec3 along = Vec3::Unit(up(scene.part.analysis));
  scene.tools[0].surface = geometry::make_plane((15.0 + away) * along, -along);
  scene.touch = {away == 0.0 ? char{1} : char{0}};
  scene.stages[0].end += away;
  return scene;
}

double last_force(const FinishedRun& done, int axis) {
  return done.last().loads.back().force[axis];
}

TEST(Flight, AToolFarAwayIsAtThePartInOneIncrement) {
  for (const bool solid : {false, true}) {
    const int axis = solid ? 2 : 1;
    const FinishedRun touching = run(die_above(solid, 0.0));
    ASSERT_EQ(touching.status, RunStatus::done);
    for (const double away : {1000.0, 1e6}) {
      const FinishedRun done = run(die_above(solid, away));
      ASSERT_EQ(done.status, RunStatus::done) << away;
      std::printf("[FLIGHT] %g mm in %s: %d increments, %d cut-backs (touching: %d, %d), force "
                  "%.6g N (%.6g N)\n",
                  away, solid ? "space" : "the plane", done.process->view().state.increment,
                  done.process->view().state.counters.cutbacks,
                  touching.process->view().state.increment,
                  touching.process->view().state.counters.cutbacks, last_force(done, axis),
                  last_force(touching, axis));
      EXPECT_LE(done.process->view().state.increment, touching.process->view().state.increment + 5);
      EXPECT_LE(done.process->view().state.counters.cutbacks,
                touching.process->view().state.counters.cutbacks + 1);
      EXPECT_NEAR(last_force(done, axis), last_force(touching, axis),
                  close * std::abs(last_force(touching, axis)));
      const Entry& first = done.recorder.entries.front();
      EXPECT_NEAR(first.report.time, away, 1e-3);
      EXPECT_LE(first.report.time, away);
      EXPECT_EQ(first.report.iterations, 0);
    }
  }
}

TEST(Flight, EndsAtTheTimesAskedForAndWhereATableTurns) {
  Scene scene = die_above(false, 1000.0);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement =
      std::array{TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {1.0, -999.0}, {2.0, -1000.75}}),
                 TimeFunction(0.0)};
  scene.stages[0].end = 2.0;
  scene.landing_times = {0.25, 0.7, 1.0};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  ASSERT_GT(done.recorder.entries.size(), 4u);
  for (const double t : {0.25, 0.7, 1.0})
    EXPECT_EQ(done.at(t).report.time, t) << "to the bit";
  EXPECT_EQ(done.recorder.entries[2].report.time, 1.0);
  EXPECT_NEAR(done.recorder.entries[3].report.time, 1.0 + 1.0 / 1.75, 1e-5) << "the touch";
  EXPECT_NEAR(last_force(done, 1), last_force(run(die_above(false, 0.0)), 1),
              close * last_force(done, 1));
}

TEST(Flight, IsNoLongerThanAnIncrementMayBe) {
  Scene scene = die_above(false, 10.0);
  scene.increments.max = 1.0;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  for (const Entry& entry : done.recorder.entries)
    EXPECT_LE(entry.report.dt, 1.0 + 1e-9);
}

TEST(Flight, AToolThatSwingsDown) {
  // A round punch on an arm of 300 mm that turns by a right angle and comes down on a strip.
  const auto swing = [](double angle) {
    Scene scene = strip_on_table(ElementKind::quad8, 5.0, 8, 3);
    scene.part.supports.push_back(held(scene.part.mesh, 0, -5.0));
    const Vec3 pivot(-300.0, 12.0, 0.0);
    contact::Tool punch =
        moving_tool("punch", geometry::make_circle({0.0, 12.0, 0.0}, 10.0, false), Vec3::Zero());
    punch.motion.velocity.reset();
    punch.motion.place = geometry::rotation_about(pivot, Vec3::UnitZ(), angle);
    punch.motion.rotation = geometry::Rotation{pivot, Vec3::UnitZ(), TimeFunction(-1.0)};
    scene.tools.push_back(std::move(punch));
    scene.part.contact_faces = faces_on(scene.part.mesh, 1, 2.0);
    scene.stages.push_back({"swing", angle + 0.1 / 300.0, {1}, false});
    return scene;
  };
  const FinishedRun near = run(swing(1e-6));
  const FinishedRun done = run(swing(0.5 * std::numbers::pi));
  ASSERT_EQ(near.status, RunStatus::done);
  ASSERT_EQ(done.status, RunStatus::done);
  std::printf("[FLIGHT] an arm that turns by 90 degrees: %d increments (%d), force %.6g (%.6g)\n",
              done.process->view().state.increment, near.process->view().state.increment,
              last_force(done, 1), last_force(near, 1));
  EXPECT_LE(done.process->view().state.increment, near.process->view().state.increment + 5);
  EXPECT_NEAR(last_force(done, 1), last_force(near, 1), close * std::abs(last_force(near, 1)));
}

/// A block on a plane of symmetry that goes along x towards a wall so far off [mm]: its back side
/// is moved by a support, or by a pusher.
Scene block_and_wall(double away, bool pushed) {
  constexpr double length = 10.0, pressed = 0.2;
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(length, 5, 0), {6, 3, 1}, {1, 1, 1}});
  scene.material = billet_steel();
  scene.part.supports.push_back(held(scene.part.mesh, 1, 0.0));
  const double way = away + pressed;
  if (!pushed) {
    Support back = held(scene.part.mesh, 0, 0.0);
    back.displacement = TimeFunction({{0.0, 0.0}, {1.0, way}});
    scene.part.supports.push_back(back);
  } else {
    scene.tools.push_back(
        moving_tool("pusher", geometry::make_plane({0, 0, 0}, {1, 0, 0}), Vec3(way, 0, 0)));
  }
  scene.tools.push_back(
      moving_tool("wall", geometry::make_plane({length + away, 0, 0}, {-1, 0, 0}), Vec3::Zero()));
  scene.touch.assign(scene.tools.size(), 0);
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  if (pushed)
    for (const mechanics::Face& face : faces_on(scene.part.mesh, 0, 0.0))
      scene.part.contact_faces.push_back(face);
  scene.stages.push_back({"go", 1.0, std::vector<char>(scene.tools.size(), 1), false});
  return scene;
}

TEST(Flight, APartThatItsSupportsCarry) {
  const FinishedRun near = run(block_and_wall(0.0, false));
  const FinishedRun done = run(block_and_wall(2e5, false));
  ASSERT_EQ(near.status, RunStatus::done);
  ASSERT_EQ(done.status, RunStatus::done);
  std::printf("[FLIGHT] carried by 2e5 mm: %d increments, %d cut-backs (%d), force %.6g (%.6g)\n",
              done.process->view().state.increment, done.process->view().state.counters.cutbacks,
              near.process->view().state.increment, last_force(done, 0), last_force(near, 0));
  EXPECT_LE(done.process->view().state.increment, near.process->view().state.increment + 5);
  EXPECT_NEAR(last_force(done, 0), last_force(near, 0), close * std::abs(last_force(near, 0)));
  EXPECT_LT(done.last().report.energy.error(), 0.02);
}

TEST(Flight, AFreePartThatAToolPushesAlong) {
  const FinishedRun near = run(block_and_wall(0.01, true));
  const FinishedRun done = run(block_and_wall(2e5, true));
  ASSERT_EQ(near.status, RunStatus::done);
  ASSERT_EQ(done.status, RunStatus::done);
  std::printf("[FLIGHT] pushed by 2e5 mm: %d increments, %d cut-backs (%d, %d), force %.6g "
              "(%.6g)\n",
              done.process->view().state.increment, done.process->view().state.counters.cutbacks,
              near.process->view().state.increment, near.process->view().state.counters.cutbacks,
              last_force(done, 0), last_force(near, 0));
  EXPECT_LE(done.process->view().state.increment, near.process->view().state.increment + 20);
  EXPECT_NEAR(last_force(done, 0), last_force(near, 0), close * std::abs(last_force(near, 0)));
}

TEST(Flight, WaitsWhileALoadChanges) {
  // A pressure grows and stays while the die is on its way: increments as usual until it stays.
  Scene scene = die_above(false, 1000.0);
  scene.part.loads.push_back(
      PressureOn{faces_on(scene.part.mesh, 0, 5.0), TimeFunction({{0.0, 0.0}, {500.0, 20.0}})});
  scene.landing_times = {500.0};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const auto before = std::count_if(done.recorder.entries.begin(), done.recorder.entries.end(),
                                    [](const Entry& entry) { return entry.report.time <= 500.0; });
  EXPECT_GT(before, 20);
  const Entry& touch = done.recorder.entries[static_cast<std::size_t>(before)];
  EXPECT_NEAR(touch.report.time, 1000.0, 0.1);
}

TEST(Flight, AToolThatLeavesAndComesBack) {
  // Pressed, far away, and pressed further: the second touch is like the first.
  Scene scene = die_above(false, 0.0);
  scene.touch = {0};
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement = std::array{
      TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {1.0, -0.5}, {2.0, 1e4}, {3.0, -0.75}}),
      TimeFunction(0.0)};
  scene.stages[0].end = 3.0;
  scene.landing_times = {1.0, 2.0};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  std::printf("[FLIGHT] there and back: %d increments, %d cut-backs\n",
              done.process->view().state.increment, done.process->view().state.counters.cutbacks);
  EXPECT_LT(done.process->view().state.increment, 200);
  const double straight = last_force(run(die_above(false, 0.0)), 1);
  EXPECT_NEAR(last_force(done, 1), straight, 5e-3 * straight) << "elastic in between";
}

TEST(Flight, NoTimeWhereAToolTouchesOrIsNear) {
  const Process process(die_above(false, 0.0));
  const Departure now{process.view().part(),
                      process.view().tools(),
                      process.view().scene.stages[0],
                      process.view().contact(),
                      process.view().model.surface.get(),
                      process.view().state.x,
                      {},
                      0.0,
                      0.0};
  EXPECT_FALSE(flight_from(now, 0.01));
  const Process above(die_above(false, 1.0));
  const Departure then{above.view().part(),
                       above.view().tools(),
                       above.view().scene.stages[0],
                       above.view().contact(),
                       above.view().model.surface.get(),
                       above.view().state.x,
                       {},
                       0.0,
                       0.0};
  EXPECT_FALSE(flight_from(then, 1.01));
  const std::optional<Flight> flight = flight_from(then, 0.9);
  ASSERT_TRUE(flight);
  EXPECT_NEAR(flight->until, 1.0, 1e-4);
  EXPECT_LT(flight->until, 1.0);
}

TEST(Flight, ATipBetweenContactPointsIsSeen) {
  // A needle of a hundredth of an element comes down between two points of a face.
  Scene scene = die_above(true, 0.0);
  scene.touch = {0};
  scene.tools[0].surface = geometry::make_sphere({1.7, 2.2, 100.0}, 0.025, false);
  scene.tools[0].motion.velocity = Vec3(0, 0, -1);
  scene.stages[0].end = 86.0;
  const Process process(std::move(scene));
  const std::optional<Flight> flight = flight_from({process.view().part(),
                                                    process.view().tools(),
                                                    process.view().scene.stages[0],
                                                    process.view().contact(),
                                                    process.view().model.surface.get(),
                                                    process.view().state.x,
                                                    {},
                                                    0.0,
                                                    0.0},
                                                   1.0);
  ASSERT_TRUE(flight);
  EXPECT_NEAR(flight->until, 100.0 - 15.0 - 0.025, 1e-3);
}

} // namespace
} // namespace billet::process::flight_test
