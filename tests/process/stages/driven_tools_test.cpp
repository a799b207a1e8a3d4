// Tools that a force or a torque drives, in whole runs.

#include "geometry/base/error.h"
#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace billet::process::driven_tools_test {
namespace {

/// A billet under a flat die that a force presses: up, kept, and taken away.
Scene pressed_by(double force) {
  Scene scene = billet_scene(ElementKind::quad4, 6, 8, contact::Coulomb{0.2}, 0.1);
  contact::Tool& die = scene.tools[0];
  die.motion.velocity.reset();
  die.motion.force =
      geometry::Drive{Vec3::Zero(), Vec3(0, -1, 0),
                      TimeFunction({{0.0, 0.0}, {1.0, force}, {2.0, force}, {3.0, 0.0}})};
  scene.stages[0].end = 3.0;
  return scene;
}

TEST(DrivenTools, hold_their_force_to_a_millionth) {
  constexpr double force = 300e3;
  const FinishedRun done = run(pressed_by(force));
  ASSERT_EQ(done.status, RunStatus::done);
  double worst = 0.0;
  for (const Entry& entry : done.recorder.entries) {
    const double t = entry.report.time;
    const double wanted = force * (t < 1.0 ? t : t < 2.0 ? 1.0 : 3.0 - t);
    worst = std::max(worst, std::abs(entry.loads[0].force[1] - wanted) / force);
  }
  const double way = done.process->view().driven(0).travel;
  std::printf("[DRIVE] force on the die: error %.1e of 300 kN (<= 1e-6), permanent set %.4f mm\n",
              worst, way);
  EXPECT_LE(worst, 1e-6);
  EXPECT_NEAR(way, 2.71, 0.02);
  EXPECT_LT(done.last().report.energy.error(), 5e-3);
}

TEST(DrivenTools, are_where_the_press_of_that_travel_is) {
  // A travel that the force has reached, prescribed, needs that force.
  const FinishedRun driven = run(pressed_by(300e3));
  ASSERT_EQ(driven.status, RunStatus::done);
  const Entry* loaded = nullptr;
  for (const Entry& entry : driven.recorder.entries)
    if (entry.report.time <= 1.0)
      loaded = &entry;
  ASSERT_NE(loaded, nullptr);
  const double travel = 15.0 - largest_position(*loaded, 2, 1);
  const double force = loaded->loads[0].force[1];
  const FinishedRun pressed =
      run(billet_scene(ElementKind::quad4, 6, 8, contact::Coulomb{0.2}, travel / 15.0));
  ASSERT_EQ(pressed.status, RunStatus::done);
  const double needed = pressed.last().loads[0].force[1];
  std::printf("[DRIVE] the travel of %.2f kN, prescribed, needs %.2f kN (<= 0.1 %% apart)\n",
              force / 1e3, needed / 1e3);
  EXPECT_NEAR(needed, force, 1e-3 * force); // what touches first does so in other increments
}

/// A strip on a plane, pulled under a roll that is pressed in and turns as it likes.
Scene idle_roll(double mu) {
  constexpr double radius = 10.0;
  Scene scene = strip_on_table(ElementKind::quad4, 6.0, 36, 6);
  Support pull = held(scene.part.mesh, 0, 6.0);
  pull.displacement = TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {3.0, 4.0}});
  scene.part.supports.push_back(pull);
  contact::Tool roll = roll_above(2.0, radius, TimeFunction({{0.0, 0.0}, {1.0, -0.1}, {3.0, -0.1}}),
                                  contact::Coulomb{mu});
  roll.motion.torque = geometry::Drive{roll.reference, Vec3::UnitZ(), TimeFunction(0.0)};
  scene.tools.push_back(std::move(roll));
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  scene.stages.push_back({"roll", 3.0, {1}, false});
  return scene;
}

TEST(DrivenTools, an_idle_roll_turns_with_the_strip) {
  for (const double mu : {0.1, 0.5}) {
    const FinishedRun done = run(idle_roll(mu));
    ASSERT_EQ(done.status, RunStatus::done);
    const double way = 10.0 * done.process->view().driven(0).turn;
    const double torque = done.last().loads[0].torque[2];
    const double force = done.last().loads[0].force[1];
    std::printf("[DRIVE] idle roll, mu %.1f: surface way %.3f mm of the strip's 4 mm, torque %.1e "
                "of force times radius; %d increments, %d cut-backs\n",
                mu, way, std::abs(torque) / (10.0 * force), done.process->view().state.increment,
                done.process->view().state.counters.cutbacks);
    // The strip leaves at 4 mm and enters, 5 % thicker, at 3.8: the roll turns with what is beneath
    // it, and most of the arc, and of the pressure, lies before the exit.
    EXPECT_GT(way, 3.80);
    EXPECT_LT(way, 3.86);
    EXPECT_LE(std::abs(torque), 1e-5 * 10.0 * force);
  }
}

TEST(DrivenTools, must_touch_what_they_press) {
  Scene scene = pressed_by(100.0);
  scene.touch = {0};
  scene.tools[0].motion.offset = Vec3(0, 1, 0);
  try {
    const Process process(std::move(scene));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::case_file);
    EXPECT_NE(std::string(error.what()).find("does not touch"), std::string::npos);
  }
}

} // namespace
} // namespace billet::process::driven_tools_test
