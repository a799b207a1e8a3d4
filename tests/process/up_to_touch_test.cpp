// Increments that end where a tool comes to touch.

#include "process/up_to_touch.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace billet::process::up_to_touch_test {
namespace {

double share(const std::vector<double>& touches) { return share_up_to_touch(touches); }

TEST(UpToTouch, EndsJustBeforeAFirstTouchInTheSecondHalf) {
  EXPECT_DOUBLE_EQ(share({0.75}), 0.7);
  EXPECT_DOUBLE_EQ(share({0.6, 0.9}), 0.55);
}

TEST(UpToTouch, LeavesATouchInTheFirstHalfOrAtTheVeryEndAsItIs) {
  for (const std::vector<double>& touches :
       {std::vector<double>{}, {0.0}, {0.45}, {0.97}, {1.0}, {0.1, 0.2, 0.4, 0.6, 0.8}})
    EXPECT_EQ(share(touches), 1.0);
}

TEST(UpToTouch, EndsBeforeASecondTouchWellAfterTheFirst) {
  EXPECT_DOUBLE_EQ(share({0.1, 0.12, 0.5, 0.9}), 0.45);
  EXPECT_EQ(share({0.02, 0.3}), 1.0) << "too soon";
  EXPECT_EQ(share({0.4, 0.96}), 1.0) << "at the very end";
}

constexpr double longest = 0x1p-6; // [s]

/// A die presses a block fast, so that the first increment is refused for its strain, and stops.
/// Another comes from the right at 1 mm/s and touches some fifteen increments later.
Scene pressed_block(double gap) {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.material = billet_steel();
  Scene scene = upsetting_scene(std::move(u));
  scene.contact_faces = free_faces(scene.mesh, scene.analysis);
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement =
      std::array{TimeFunction(0.0), TimeFunction({{0.0, 0.0}, {longest, -4.5}, {1.0, -4.5}}),
                 TimeFunction(0.0)};
  scene.tools.push_back(moving_tool(
      "side", geometry::make_plane(Vec3(20.0 + gap, 0, 0), -Vec3::UnitX()), -Vec3::UnitX()));
  scene.touch.assign(2, 0);
  scene.stages[0].tools.assign(2, 1);
  scene.stages[0].end = 32.0 * longest;
  scene.increments.first = scene.increments.max = longest;
  return scene;
}

/// How long before the touch the last increment without it ends, in longest ones.
double left_before_touch(const FinishedRun& done, double gap) {
  double side = 0.0, left = 1e9;
  for (const Entry& entry : done.recorder.entries) {
    side = largest_position(entry, 2, 0);
    const double touch = 20.0 + gap - side; // the block rests from the end of the press on
    if (entry.report.time > longest && entry.report.time < touch)
      left = (touch - entry.report.time) / longest;
  }
  return left;
}

TEST(UpToTouch, IsDoneForSomeIncrementsAfterARefusedOne) {
  int just_before = 0;
  for (int eighth = 0; eighth < 8; ++eighth) {
    // Pressed to 5.5 mm the block is some 18.1 mm wide: ten of the longest increments to go.
    const double gap = -1.7164 + eighth * longest / 8.0;
    const FinishedRun done = run(pressed_block(gap));
    ASSERT_EQ(done.status, RunStatus::done);
    ASSERT_GT(done.process->cutbacks(), 0);
    ASSERT_GT(done.last().loads[1].force.norm(), 0.0);
    const double left = left_before_touch(done, gap);
    EXPECT_FALSE(left > 0.55 && left < 0.94) << left;
    just_before += std::abs(left - 0.05) < 0.01 ? 1 : 0;
  }
  EXPECT_GE(just_before, 3);
}

} // namespace
} // namespace billet::process::up_to_touch_test
