#include "geometry/base/error.h"
#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace billet::process::process_test {
namespace {

/// A cylinder of radius 10 and half height 15, few elements.
Scene small_billet(double reduction, const contact::Friction& friction = contact::Frictionless{}) {
  return billet_scene(ElementKind::quad8, 3, 4, friction, reduction);
}

Fault fault_of(Scene scene) {
  try {
    const Process process(std::move(scene));
  } catch (const Error& error) {
    EXPECT_FALSE(std::string(error.what()).empty());
    return error.fault();
  }
  ADD_FAILURE() << "no error";
  return Fault::usage;
}

TEST(Process, BringsAToolToTouchFromBothSides) {
  for (const double away : {3.0, -0.4}) {
    Scene scene = small_billet(0.01);
    scene.tools[0].motion.offset.setZero();
    scene.tools[0].surface = geometry::make_plane({0, 15.0 + away, 0}, {0, -1, 0});
    const FinishedRun done = run(std::move(scene));
    ASSERT_EQ(done.status, RunStatus::done);
    // Touching at the start: 0.15 mm of elastic and plastic upsetting, the force of a 1 %
    // reduction.
    EXPECT_NEAR(done.process->view().tools()[0].motion.offset[1], -away, 1e-9);
    EXPECT_NEAR(largest_position(done.last(), 2, 1), 14.85, 1e-3);
  }
}

TEST(Process, RefusesATouchingToolThatStandsStill) {
  Scene scene = small_billet(0.01);
  scene.tools[0].motion.velocity = Vec3::Zero();
  EXPECT_EQ(fault_of(std::move(scene)), Fault::case_file);
}

TEST(Process, RefusesAToolThatCannotTouch) {
  Scene scene = small_billet(0.01);
  scene.tools[0].surface = geometry::make_circle({200.0, 30.0, 0}, 5.0, false); // passes by
  EXPECT_EQ(fault_of(std::move(scene)), Fault::geometry);
}

TEST(Process, RefusesAWorkpieceThatOverlapsATool) {
  Scene scene = small_billet(0.01);
  scene.touch = {0};
  scene.tools[0].surface = geometry::make_plane({0, 14.0, 0}, {0, -1, 0});
  EXPECT_EQ(fault_of(std::move(scene)), Fault::geometry);
}

TEST(Process, RefusesABodyThatNothingHolds) {
  Scene scene = small_billet(0.01);
  scene.tools.clear();
  scene.touch.clear();
  scene.part.supports.resize(1); // the radius only
  scene.stages[0].tools.clear();
  EXPECT_EQ(fault_of(std::move(scene)), Fault::case_file);
}

TEST(Process, GroundsABodyThatOnlyToolsHold) {
  // Two dies press a billet that no support holds along its axis.
  Upsetting u;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(10, 15, 0), {3, 4, 1}, {1, 1, 1}});
  u.reduction = 0.1;
  Scene scene = upsetting_scene(std::move(u));
  scene.part.supports.pop_back();
  scene.tools.push_back(
      moving_tool("anvil", geometry::make_plane({0, 0, 0}, {0, 1, 0}), Vec3::Zero()));
  scene.touch = {1, 0};
  scene.part.contact_faces = mechanics::boundary_faces(scene.part.mesh);
  scene.stages[0].tools = {1, 1};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(done.process->view().model.free_motions, 1);
  const double down = done.last().loads[0].force[1], up_force = done.last().loads[1].force[1];
  EXPECT_GT(down, 1e5);
  constexpr double share =
      1e-6; // of the force: Newton's tolerance and what the stabilization carries
  EXPECT_NEAR(down, -up_force, share * down);
  EXPECT_LT(done.last().report.energy.stabilization, share * done.last().report.energy.external);
}

TEST(Process, StopsWhenAnObserverAsksForIt) {
  Process process(small_billet(0.3));
  Recorder recorder;
  recorder.stop_after = 3;
  EXPECT_EQ(process.run({&recorder}), RunStatus::stopped);
  EXPECT_EQ(process.view().state.increment, 3);
  EXPECT_EQ(recorder.entries.size(), 3u);
  EXPECT_EQ(recorder.starts, 1);
  EXPECT_EQ(recorder.finishes, 1);
  EXPECT_TRUE(recorder.failures.empty());
}

TEST(Process, EndsIncrementsAtLandingTimesAndStages) {
  Scene scene = small_billet(0.2);
  scene.landing_times = {0.7, 1.3, 2.9};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  for (const double t : {0.7, 1.3, 2.9, 3.0})
    EXPECT_EQ(done.at(t).report.time, t) << "to the bit";
  double last = 0.0;
  int number = 0;
  for (const Entry& entry : done.recorder.entries) {
    EXPECT_EQ(entry.report.increment, ++number);
    EXPECT_NEAR(entry.report.time, last + entry.report.dt, 1e-9);
    last = entry.report.time;
  }
}

TEST(Process, CutsBackFromAnIncrementTooLargeAndLosesNothing) {
  // 60 % at once is more plastic strain than an increment may hold; the homogeneous force is exact
  // whatever the path (FRM-01), so a trial that left a trace would show.
  Scene scene = small_billet(0.6);
  scene.increments.first = scene.increments.max = 9.0;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_GT(done.process->view().state.counters.cutbacks, 0);
  EXPECT_GT(done.process->view().state.counters.wasted_iterations, 0);
  EXPECT_GT(done.recorder.entries.front().report.cutbacks, 0);
  const double h = largest_position(done.last(), 2, 1);
  const double e = std::log(15.0 / h);
  const double exact =
      100.0 * std::numbers::pi * (700.0 + 300.0 * e) / (1.0 + 300.0 / 200e3) * 15.0 / h;
  EXPECT_NEAR(done.last().loads[0].force[1], exact, 1e-5 * exact);
}

TEST(Process, ShortensIncrementsOfTheCaseThatMissEnergy) {
  // From nothing to well beyond yield at once: the trapezoid would see half of the work. (P.24)
  Scene scene = small_billet(0.1);
  scene.increments.first = scene.increments.max = 1.5;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EnergyBalance before;
  for (const Entry& entry : done.recorder.entries) {
    const bool long_one = entry.report.dt > 1.5 / 50.0 * (1.0 + 1e-9);
    EXPECT_TRUE(!long_one || entry.report.energy.error_since(before) <= 0.05) << entry.report.time;
    before = entry.report.energy;
  }
  EXPECT_LT(done.last().report.energy.error(), 0.03);
  EXPECT_GT(done.recorder.entries.front().report.cutbacks, 0);
  EXPECT_LT(done.recorder.entries.size(), 30u) << "what flows evenly misses nothing in long steps";
}

TEST(Process, ShortensIncrementsThatMissMuchOfAllWork) {
  // Pressed, let go, and pressed again in a longer stage: its first increment leads from nothing to
  // the flow stress, and alone would miss one per cent of all work so far. (P.24)
  Scene scene = small_billet(0.4);
  scene.touch = {0};
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement = std::array{
      TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {1.0, -1.0}, {1.1, -0.9}, {8.0, -4.5}}),
      TimeFunction(0.0)};
  scene.stages = {{"once", 1.0, {1}, false}, {"back", 1.1, {1}, false}, {"again", 8.0, {1}, false}};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  double before = 0.0, largest = 0.0;
  for (const Entry& entry : done.recorder.entries) {
    const double missing = entry.report.energy.missing();
    if (entry.report.time > 1.1 && entry.report.dt > 6.9 / 500.0)
      largest = std::max(largest, std::abs(missing - before) / entry.report.energy.external);
    before = missing;
  }
  EXPECT_LE(largest, 1.001e-3);
  EXPECT_LT(done.last().report.energy.error(), 0.005);
}

TEST(Process, EndsAnImpossibleCaseWithAPostMortem) {
  // The die would have to go through the anvil: 99.9 % with sticking.
  Scene scene = small_billet(0.999, contact::Sticking{});
  scene.increments.min = 0.02;
  scene.stop = {.on_full_cavity = false, .on_tools_together = false};
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::not_converged);
  ASSERT_EQ(done.recorder.failures.size(), 1u);
  const PostMortem& post = done.recorder.failures[0];
  EXPECT_FALSE(post.reason.empty());
  EXPECT_FALSE(post.tried.empty());
  EXPECT_GT(post.time, done.process->view().state.time);
  EXPECT_GE(post.worst_node, 0);
  EXPECT_LT(post.worst_node, done.process->view().mesh().n_points());
  EXPECT_TRUE(post.worst_position.allFinite());
  EXPECT_EQ(done.recorder.finishes, 1);
  for (const double x : done.process->view().positions())
    EXPECT_TRUE(std::isfinite(x));
  // The committed state is the last accepted increment.
  EXPECT_EQ(done.process->view().state.time, done.last().report.time);
}

} // namespace
} // namespace billet::process::process_test
