#include "geometry/motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace billet::geometry::motion_test {
namespace {

constexpr double rounding = 1e-13;
constexpr double pi = std::numbers::pi;

TEST(Motion, ToToolUndoesToSpace) {
  Pose pose = rotation_about({1, 2, 3}, Vec3(1, 2, 2) / 3.0, 0.8);
  pose.translation += Vec3(5, -6, 7);
  const Vec3 x(0.3, -0.4, 0.5);
  EXPECT_NEAR((pose.to_tool(pose.to_space(x)) - x).norm(), 0.0, rounding * 10);
}

TEST(Motion, PointsOnTheAxisStayWhereTheyAre) {
  const Pose pose = rotation_about({1, 2, 0}, Vec3::UnitZ(), pi / 2);
  EXPECT_NEAR((pose.to_space({1, 2, 5}) - Vec3(1, 2, 5)).norm(), 0.0, rounding);
  EXPECT_NEAR((pose.to_space({2, 2, 0}) - Vec3(1, 3, 0)).norm(), 0.0, rounding);
}

TEST(Motion, RestsFromATimeOn) {
  Motion motion;
  motion.velocity = Vec3(1, 0, 0);
  motion.rotation = Rotation{Vec3::Zero(), Vec3::UnitZ(), TimeFunction(2.0)};
  motion.rests_from = 3.0;
  for (const double time : {3.0, 4.0, 1e6}) {
    EXPECT_EQ(motion.translation(time), Vec3(3, 0, 0));
    EXPECT_EQ(motion.angle(time), 6.0);
  }
  EXPECT_EQ(motion.translation(2.0), Vec3(2, 0, 0));
}

TEST(Motion, VelocityDisplacementOffsetAndRotationAddUp) {
  Motion fixed;
  EXPECT_EQ(fixed.pose(3.0).translation, Vec3::Zero());
  Motion punch;
  punch.velocity = Vec3(0, -2, 0);
  punch.offset = Vec3(0, 0.5, 0);
  EXPECT_NEAR((punch.pose(1.5).translation - Vec3(0, -2.5, 0)).norm(), 0.0, rounding);
  Motion roll;
  roll.rotation = Rotation{{0, 1, 0}, Vec3::UnitZ(), TimeFunction{{{0.0, 0.0}, {1.0, 2.0}}}};
  roll.displacement = std::array<TimeFunction, 3>{TimeFunction{{{0.0, 0.0}, {2.0, 4.0}}}, 0.0, 0.0};
  EXPECT_NEAR(roll.angle(2.0), 3.0, rounding); // a ramp to 1 s, then constant
  const Vec3 on_axis = roll.pose(2.0).to_space({0, 1, 0});
  EXPECT_NEAR((on_axis - Vec3(4, 1, 0)).norm(), 0.0, rounding);
}

} // namespace
} // namespace billet::geometry::motion_test
