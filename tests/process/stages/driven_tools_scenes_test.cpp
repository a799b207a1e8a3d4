// Tools that a force drives: in space, in any frame and unit, and when they leave or come by stage.

#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace billet::process::driven_tools_scenes_test {
namespace {

constexpr double side = 10.0;   // of the block [mm]
constexpr double force = 100e3; // it yields at 70 kN [N]

/// Where the scene is and in which unit of length: with newtons, stresses follow.
struct Setting {
  geometry::Pose frame;    ///< in mm
  double millimetre = 1.0; ///< in the unit of the scene
};

/// A block that only friction holds, between an anvil and a die that a force presses and releases.
Scene block_between_dies(const Setting& setting) {
  const double mm = setting.millimetre, MPa = 1.0 / (mm * mm);
  const auto place = [&](const Vec3& x) { return Vec3(mm * setting.frame.to_space(x)); };
  const Vec3 along = setting.frame.rotation.col(2);
  Scene scene;
  scene.part.analysis = Analysis::solid;
  scene.part.mesh = mechanics::box_mesh(
      {ElementKind::hex8, Vec3::Zero(), Vec3::Constant(side), {2, 2, 2}, {1, 1, 1}});
  for (Vec3& p : scene.part.mesh.points)
    p = place(p);
  scene.material = {{200e3 * MPa, 0.3}, mechanics::Linear{700.0 * MPa, 300.0 * MPa}};
  scene.tools.push_back(moving_tool("anvil", geometry::make_plane(place(Vec3::Zero()), along),
                                    Vec3::Zero(), contact::Coulomb{0.2}));
  scene.tools.push_back(moving_tool("die", geometry::make_plane(place(Vec3(0, 0, side)), -along),
                                    Vec3::Zero(), contact::Coulomb{0.2}));
  scene.tools[1].motion.velocity.reset();
  scene.tools[1].motion.force =
      geometry::Drive{Vec3::Zero(), -along, TimeFunction({{0.0, 0.0}, {1.0, force}, {2.0, 0.0}})};
  scene.touch = {0, 0};
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.stages.push_back({"press", 2.0, {1, 1}, false});
  scene.landing_times = {1.0};
  scene.increments.first = scene.increments.max = 0.02; // the same, whatever rounding does
  return scene;
}

/// What is compared of a run; lengths in mm.
struct Figures {
  double worst_force; ///< largest difference from the load, share of its largest [-]
  double set;         ///< travel of the die that remains
  int iterations;
  int cutbacks;
};

Figures figures(const Setting& setting) {
  const FinishedRun done = run(block_between_dies(setting));
  EXPECT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(done.process->view().model.free_motions, 6);
  Figures found{0.0, done.process->view().driven(1).travel / setting.millimetre,
                done.process->view().state.counters.iterations,
                done.process->view().state.counters.cutbacks};
  for (const Entry& entry : done.recorder.entries) {
    const double t = entry.report.time;
    const Vec3 wanted = force * (t < 1.0 ? t : 2.0 - t) * setting.frame.rotation.col(2);
    found.worst_force = std::max(found.worst_force, (entry.loads[1].force - wanted).norm() / force);
  }
  std::printf("[DRIVE] in space: force off by %.1e of %.0f kN, set %.12g mm, %d iterations, "
              "%d cut-backs\n",
              found.worst_force, force / 1e3, found.set, found.iterations, found.cutbacks);
  return found;
}

TEST(DrivenTools, hold_their_force_in_space_whatever_the_unit) {
  // Powers of two scale without rounding: any difference would be a constant with a dimension.
  const Figures plain = figures({});
  EXPECT_LE(plain.worst_force, 1e-6);
  EXPECT_GT(plain.set, 0.1 * side);
  for (const double unit : {0x1p-10, 0x1p10}) {
    const Figures other = figures({.frame = {}, .millimetre = unit});
    EXPECT_EQ(other.iterations, plain.iterations);
    EXPECT_EQ(other.cutbacks, plain.cutbacks);
    EXPECT_EQ(other.worst_force, plain.worst_force);
    EXPECT_EQ(other.set, plain.set);
  }
}

TEST(DrivenTools, hold_their_force_in_any_frame_and_in_metres) {
  constexpr double same = 1e-7; // trials differ by rounding, and stop at Newton's tolerance
  const Figures plain = figures({});
  for (const Setting& setting :
       {Setting{.frame = {}, .millimetre = 1e-3},
        Setting{.frame = geometry::rotation_about({3, -8, 5}, Vec3(1, 2, -2) / 3.0, 1.1)},
        Setting{.frame = geometry::rotation_about({3, -8, 5}, Vec3::UnitX(), std::numbers::pi),
        .millimetre = 1e-3}}) {
    const Figures other = figures(setting);
    EXPECT_EQ(other.cutbacks, plain.cutbacks);
    EXPECT_LE(other.worst_force, 1e-6);
    EXPECT_NEAR(other.set, plain.set, same * side);
  }
}

/// A billet that a force presses until t = 1 and would go on pressing.
Scene pressed_without_end() {
  constexpr double load = 300e3;
  Scene scene = billet_scene(ElementKind::quad4, 4, 6, contact::Coulomb{0.2}, 0.1);
  contact::Tool& die = scene.tools[0];
  die.motion.velocity.reset();
  die.motion.force =
      geometry::Drive{Vec3::Zero(), -Vec3::UnitY(), TimeFunction({{0.0, 0.0}, {1.0, load}})};
  scene.stages = {{"press", 1.0, {1}, false}, {"rest", 2.0, {0}, false}};
  return scene;
}

/// The die has gone at t = 1 and stays where it was; the billet springs back and rests.
void expect_release(Scene scene, const char* how) {
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done) << how;
  const Entry& pressed = done.at(1.0);
  const double height = largest_position(pressed, 2, 1);
  const double sprung = largest_position(done.last(), 2, 1) - height;
  std::printf("[DRIVE] the die leaves by %s: %.4f mm pressed, %.4f mm back, energy error %.1e\n",
              how, 15.0 - height, sprung, done.last().report.energy.error());
  EXPECT_GT(pressed.loads[0].force[1], 0.99 * 300e3) << how;
  EXPECT_EQ(done.last().loads[0].force, Vec3::Zero()) << how;
  EXPECT_NEAR(done.process->view().driven(0).travel, 15.0 - height, 1e-2) << how;
  EXPECT_GT(sprung, 0.02) << how;
  EXPECT_LT(done.last().report.energy.error(), 5e-3) << how;
}

TEST(DrivenTools, leave_by_stage_by_time_and_by_unloading) {
  expect_release(pressed_without_end(), "stage");
  Scene timed = pressed_without_end();
  timed.tools[0].active_to = 1.0;
  timed.stages = {{"press and rest", 2.0, {1}, false}};
  timed.landing_times = {1.0};
  expect_release(std::move(timed), "time");
  Scene unloaded = pressed_without_end();
  unloaded.stages[1] = {"spring back", 2.0, {0}, true};
  expect_release(std::move(unloaded), "unloading");
}

TEST(DrivenTools, come_by_stage) {
  // Pressed by a prescribed die, then, where that has left it, by a force: it need not touch
  // before.
  Scene scene = pressed_without_end();
  contact::Tool first = flat_die(Analysis::axisymmetric, 15.0, contact::Coulomb{0.2});
  first.motion.velocity = Vec3(0, -1, 0);
  scene.tools.push_back(std::move(first));
  scene.touch = {0, 1};
  contact::Tool& die = scene.tools[0];
  die.motion.place.translation = Vec3(0, -1.0, 0); // 14 mm: a little below where the billet then is
  die.motion.force->load = TimeFunction({{1.0, 0.0}, {2.0, 400e3}});
  scene.stages = {{"prescribed", 1.0, {0, 1}, false}, {"driven", 2.0, {1, 0}, false}};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_NEAR(done.last().loads[0].force[1], 400e3, 0.4);
  EXPECT_EQ(done.last().loads[1].force, Vec3::Zero());
  EXPECT_GT(done.process->view().driven(0).travel, 0.0);
}

} // namespace
} // namespace billet::process::driven_tools_scenes_test
