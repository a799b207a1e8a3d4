// Increments that end where a tool comes to touch.

#include "process/increment/up_to_touch.h"
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
/// Another comes from the right at 1 mm/s.
///
/// @param place  of the other at the beginning
Scene pressed_block(ElementKind kind, double place) {
  const bool in_space = kind == ElementKind::hex8;
  Upsetting u;
  u.analysis = in_space ? Analysis::solid : Analysis::plane_strain;
  const Vec3 corner(10, 10, in_space ? 10 : 0);
  const auto cells = in_space ? std::array{2, 2, 2} : std::array{4, 4, 1};
  u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), corner, cells, {1, 1, 1}});
  u.height = 10.0;
  u.material = billet_steel();
  Scene scene = upsetting_scene(std::move(u));
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  const TimeFunction rests(0.0),
      comes({{0.0, 0.0}, {longest, -4.5}, {1.0, -4.5 - 1e-6}}); // no flight
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement =
      std::array{rests, in_space ? rests : comes, in_space ? comes : rests};
  scene.tools.push_back(
      moving_tool("side", geometry::make_plane(Vec3(place, 0, 0), -Vec3::UnitX()), -Vec3::UnitX()));
  scene.touch.assign(2, 0);
  scene.stages[0].tools.assign(2, 1);
  scene.stages[0].end = 32.0 * longest;
  scene.increments.first = scene.increments.max = longest;
  return scene;
}

double side(const Entry& entry, ElementKind kind) {
  return largest_position(entry, mechanics::dimension(kind), 0);
}

/// How long before the touch the last increment without it ends, in longest ones.
double left_before_touch(const FinishedRun& done, ElementKind kind, double place) {
  double left = 1e9;
  for (const Entry& entry : done.recorder.entries) {
    const double touch = place - side(entry, kind); // the block rests from the end of the press on
    if (entry.report.time > longest && entry.report.time < touch)
      left = (touch - entry.report.time) / longest;
  }
  return left;
}

class UpToTouchIn : public testing::TestWithParam<ElementKind> {};

TEST_P(UpToTouchIn, IsDoneForSomeIncrementsAfterARefusedOne) {
  const ElementKind kind = GetParam();
  constexpr double far_away = 100.0;
  const FinishedRun alone = run(pressed_block(kind, far_away));
  ASSERT_EQ(alone.status, RunStatus::done);
  int just_before = 0;
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double place = side(alone.last(), kind) + (10.0 + eighth / 8.0) * longest;
    const FinishedRun done = run(pressed_block(kind, place));
    ASSERT_EQ(done.status, RunStatus::done);
    ASSERT_GT(done.process->view().state.counters.cutbacks, 0);
    ASSERT_GT(done.last().loads[1].force.norm(), 0.0);
    const double left = left_before_touch(done, kind, place);
    EXPECT_FALSE(left > 0.55 && left < 0.94) << left;
    just_before += std::abs(left - 0.05) < 0.01 ? 1 : 0;
  }
  EXPECT_GE(just_before, 3);
}

INSTANTIATE_TEST_SUITE_P(PlaneAndSpace,
                         UpToTouchIn,
                         testing::Values(ElementKind::quad4, ElementKind::hex8));

} // namespace
} // namespace billet::process::up_to_touch_test
