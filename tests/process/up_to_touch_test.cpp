// Increments that end where a tool comes to touch.

#include "process/run.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace billet::process::up_to_touch_test {
namespace {

constexpr double longest = 0x1p-6; // [s]; sums of it are exact

/// A block without Poisson's ratio that a die presses, while others come from the right at 1 mm/s:
/// they touch after so many of the longest increments.
Scene pressed_block(const std::vector<double>& touches) {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.material = elastic_body(1e3, 0.0);
  Scene scene = upsetting_scene(std::move(u));
  scene.contact_faces = free_faces(scene.mesh, scene.analysis);
  for (const double touch : touches)
    scene.tools.push_back(moving_tool(
        "side", geometry::make_plane(Vec3(10.0 + touch * longest, 0, 0), -Vec3::UnitX()),
        -Vec3::UnitX()));
  scene.touch.assign(scene.tools.size(), 0);
  scene.stages[0].tools.assign(scene.tools.size(), 1);
  scene.stages[0].end = 32.0 * longest;
  scene.increments.first = scene.increments.max = longest;
  return scene;
}

/// Ends of the increments, in longest ones.
std::vector<double> ends(const FinishedRun& done) {
  EXPECT_EQ(done.status, RunStatus::done);
  std::vector<double> times;
  for (const Entry& entry : done.recorder.entries)
    times.push_back(entry.report.time / longest);
  return times;
}

bool ends_at(const FinishedRun& done, double time) {
  for (const double end : ends(done))
    if (std::abs(end - time) < 1e-6)
      return true;
  return false;
}

TEST(UpToTouch, EndsAnIncrementJustBeforeATouchInItsSecondHalf) {
  const FinishedRun done = run(pressed_block({21.75}));
  EXPECT_TRUE(ends_at(done, 21.0));
  EXPECT_TRUE(ends_at(done, 21.7));
  EXPECT_FALSE(ends_at(done, 22.0));
  EXPECT_TRUE(ends_at(done, 22.7)) << "the one that touches is a whole one";
  EXPECT_GT(done.last().loads[1].force.norm(), 0.0);
}

TEST(UpToTouch, LeavesATouchInTheFirstHalfOrAtTheVeryEndAsItIs) {
  for (const double touch : {21.25, 21.97}) {
    const FinishedRun done = run(pressed_block({touch}));
    EXPECT_TRUE(ends_at(done, 22.0)) << touch;
    EXPECT_EQ(ends(done).size(), 32u) << touch;
  }
}

TEST(UpToTouch, EndsBeforeASecondTouchThatComesWellAfterTheFirst) {
  EXPECT_TRUE(ends_at(run(pressed_block({21.1, 21.5})), 21.45));
  EXPECT_TRUE(ends_at(run(pressed_block({21.2, 21.4})), 22.0));
}

TEST(UpToTouch, ComesToATouchAtALandingInOneIncrement) {
  Scene scene = pressed_block({22.0});
  scene.landing_times = {22.0 * longest};
  EXPECT_EQ(ends(run(std::move(scene))).size(), 32u);
}

TEST(UpToTouch, DoesNotWaitForToolsThatTurn) {
  Scene scene = pressed_block({21.75});
  scene.tools[1].motion.rotation =
      geometry::Rotation{Vec3(10.0, 0, 0), Vec3::UnitZ(), TimeFunction(1e-9)};
  EXPECT_EQ(ends(run(std::move(scene))).size(), 32u);
}

} // namespace
} // namespace billet::process::up_to_touch_test
