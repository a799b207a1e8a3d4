// Increments that end where a tool comes to touch.

#include "process/run.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace billet::process::up_to_touch_test {
namespace {

constexpr double longest = 0.02;

/// A block without Poisson's ratio that a die presses, in increments of 0.02 s, while others come
/// from the right at 1 mm/s: each has so far to go.
Scene pressed_block(const std::vector<double>& gaps) {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.material = elastic_body(1e3, 0.0);
  Scene scene = upsetting_scene(std::move(u));
  scene.contact_faces = free_faces(scene.mesh, scene.analysis);
  for (const double gap : gaps)
    scene.tools.push_back(moving_tool(
        "side", geometry::make_plane(Vec3(10.0 + gap, 0, 0), -Vec3::UnitX()), -Vec3::UnitX()));
  scene.touch.assign(scene.tools.size(), 0);
  scene.stages[0].tools.assign(scene.tools.size(), 1);
  scene.stages[0].end = 0.5;
  scene.increments.first = scene.increments.max = longest;
  return scene;
}

std::vector<double> ends(const FinishedRun& done) {
  EXPECT_EQ(done.status, RunStatus::done);
  std::vector<double> times;
  for (const Entry& entry : done.recorder.entries)
    times.push_back(entry.report.time);
  return times;
}

bool ends_at(const FinishedRun& done, double time) {
  for (const double end : ends(done))
    if (std::abs(end - time) < 1e-9)
      return true;
  return false;
}

TEST(UpToTouch, EndsAnIncrementJustBeforeATouchInItsSecondHalf) {
  const FinishedRun done = run(pressed_block({0.335})); // three quarters of the way to 0.34
  EXPECT_TRUE(ends_at(done, 0.335 - 0.05 * longest));
  EXPECT_FALSE(ends_at(done, 0.34));
  EXPECT_TRUE(ends_at(done, 0.32));
  EXPECT_TRUE(ends_at(done, 0.335 + 0.95 * longest)) << "the one that touches is a whole one";
  EXPECT_GT(done.last().loads[1].force.norm(), 0.0);
}

TEST(UpToTouch, LeavesATouchInTheFirstHalfOrAtTheVeryEndAsItIs) {
  for (const double gap : {0.325, 0.3395}) {
    const FinishedRun done = run(pressed_block({gap}));
    EXPECT_TRUE(ends_at(done, 0.34)) << gap;
    EXPECT_EQ(ends(done).size(), 25u) << gap;
  }
}

TEST(UpToTouch, EndsBeforeASecondTouchThatComesWellAfterTheFirst) {
  const FinishedRun two = run(pressed_block({0.322, 0.330})); // 0.1 and 0.5 of an increment
  EXPECT_TRUE(ends_at(two, 0.330 - 0.05 * longest));
  const FinishedRun together = run(pressed_block({0.322, 0.326})); // 0.1 and 0.3
  EXPECT_TRUE(ends_at(together, 0.34));
}

TEST(UpToTouch, ComesToATouchAtALandingInOneIncrement) {
  Scene scene = pressed_block({0.34});
  scene.landing_times = {0.34};
  for (const double end : ends(run(std::move(scene))))
    EXPECT_FALSE(end > 0.32 + 1e-9 && end < 0.34 - 1e-9) << end;
}

TEST(UpToTouch, DoesNotWaitForToolsThatTurn) {
  Scene scene = pressed_block({0.335});
  scene.tools[1].motion.rotation =
      geometry::Rotation{Vec3(10.335, 0, 0), Vec3::UnitZ(), TimeFunction(1e-9)};
  const FinishedRun done = run(std::move(scene));
  EXPECT_TRUE(ends_at(done, 0.34));
  EXPECT_EQ(ends(done).size(), 25u);
}

} // namespace
} // namespace billet::process::up_to_touch_test
