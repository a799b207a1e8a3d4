// Cold rolling of a strip that nothing but friction draws in. (VALIDATION FRM-11)

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace billet::process {
namespace {

constexpr double radius = 100.0, entry = 2.0, leaving = 1.6; // roll and strip thicknesses [mm]
constexpr double centre = 0.5 * leaving + radius;            // of the upper roll, above the middle
constexpr double speed = 10.0;                               // of the roll's surface [mm/s]
constexpr double pushed = 2.0;                               // way of the plate behind the strip

/// Where the strip first touches the roll.
double bite() {
  return -std::sqrt(radius * radius - (centre - 0.5 * entry) * (centre - 0.5 * entry));
}

/// The upper half of the strip, its front at the roll, pushed in by a plate that then stays behind.
Scene rolled_strip(double mu) {
  constexpr double length = 16.0;
  Scene scene;
  scene.analysis = Analysis::plane_strain;
  scene.mesh = mechanics::box_mesh({ElementKind::quad4,
                                    Vec3(bite() - length, 0, 0),
                                    Vec3(bite(), 0.5 * entry, 0),
                                    {40, 3, 1},
                                    {1, 1, 1}});
  scene.material = {{200e3, 0.3}, mechanics::Perfect{200.0 * std::numbers::sqrt3}}; // 2k = 400
  scene.supports.push_back(held(scene.mesh, 1, 0.0));
  contact::Tool roll = moving_tool("roll", geometry::make_circle({0, centre, 0}, radius, false),
                                   Vec3::Zero(), contact::Coulomb{mu, 0.0, 1e9, true});
  roll.motion.rotation =
      geometry::Rotation{{0, centre, 0}, Vec3::UnitZ(), TimeFunction(speed / radius)};
  roll.reference = Vec3(0, centre, 0);
  contact::Tool plate =
      moving_tool("plate", geometry::make_plane({bite() - length, 0, 0}, {1, 0, 0}), Vec3::Zero());
  plate.motion.velocity.reset();
  plate.motion.displacement =
      std::array{TimeFunction({{0.0, 0.0}, {0.2, pushed}}), TimeFunction(0.0), TimeFunction(0.0)};
  scene.tools.push_back(std::move(roll));
  scene.tools.push_back(std::move(plate));
  scene.touch = {0, 0};
  scene.contact_faces = free_faces(scene.mesh, scene.analysis);
  scene.stages.push_back({"roll", 1.2, {1, 1}, false});
  return scene;
}

TEST(Rolling, FRM_11_friction_above_the_bite_draws_the_strip_in) {
  const FinishedRun done = run(rolled_strip(0.08));
  ASSERT_EQ(done.status, RunStatus::done);
  double force = 0.0, torque = 0.0, time = 0.0;
  for (const Entry& now : done.recorder.entries) {
    if (now.report.time < 0.8) // the front has left the gap, the tail is not near
      continue;
    force += now.report.dt * now.loads[0].force[1];
    torque -= now.report.dt * now.loads[0].torque[2];
    time += now.report.dt;
  }
  std::printf("[FRM-11] force %.0f N/mm (slab 2770, 5 %%), torque %.0f N mm/mm (8601, 8 %%); "
              "%d increments, %d cut-backs, energy %.1e\n",
              force / time, torque / time, done.process->increments(), done.process->cutbacks(),
              done.last().report.energy.error());
  EXPECT_NEAR(force / time, 2770.0, 0.05 * 2770.0);
  EXPECT_NEAR(torque / time, 8601.0, 0.08 * 8601.0);
  EXPECT_EQ(done.last().loads[1].force.norm(), 0.0) << "nothing pushes any more";
  EXPECT_LT(done.last().report.energy.error(), 5e-3);
  // With a turn of the shear that is a jump it takes ten times as many.
  EXPECT_LT(done.process->increments() + done.process->cutbacks(), 250);
}

TEST(Rolling, FRM_11_friction_below_the_bite_does_not) {
  const FinishedRun done = run(rolled_strip(0.05)); // tan of the bite angle: 0.0633
  ASSERT_EQ(done.status, RunStatus::done);
  const double front = largest_position(done.last(), 2, 0);
  const contact::ToolLoad& roll = done.last().loads[0];
  std::printf(
      "[FRM-11] mu 0.05: the front is %.4f mm past the bite, pushed by %.1f mm; torque %.4f of "
      "mu F R\n",
      front - bite(), pushed, -roll.torque[2] / (0.05 * roll.force[1] * radius));
  EXPECT_LT(front - bite(), 1.25 * pushed);
  EXPECT_NEAR(-roll.torque[2], 0.05 * roll.force[1] * radius, 1e-3 * roll.force[1] * radius)
      << "the whole arc slips";
}

} // namespace
} // namespace billet::process
