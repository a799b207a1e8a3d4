// CON-08 in a run: press, lift, press again.

#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace billet::process::contact_separation_test {
namespace {

constexpr double height = 15.0;

/// A die that goes down by `depth`, up beyond the first touch, and down again, elastic part.
Scene press_and_lift(ElementKind kind, const contact::Friction& friction, double depth) {
  Upsetting u;
  u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, height, 0), {4, 4, 1}, {1, 1, 1}});
  u.friction = friction;
  u.material = elastic_body(200e3, 0.3);
  Scene scene = upsetting_scene(std::move(u));
  contact::Tool& die = scene.tools[0];
  die.motion.velocity.reset();
  die.motion.displacement =
      std::array{TimeFunction(0.0), TimeFunction({{0, 0}, {1, -depth}, {3, depth}, {5, -depth}}),
                 TimeFunction(0.0)};
  scene.stages[0].end = 5.0;
  scene.landing_times = {1.0, 2.0, 3.0, 4.0};
  scene.increments.first = scene.increments.max = 0.1;
  return scene;
}

TEST(Separation, ReachesZeroForceAtZeroGapAndNeverPulls) {
  constexpr double depth = 0.1;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8}) {
    const FinishedRun done = run(press_and_lift(kind, contact::Coulomb{0.3}, depth));
    ASSERT_EQ(done.status, RunStatus::done);
    double pull = 0.0, apart = 0.0;
    for (const Entry& entry : done.recorder.entries) {
      pull = std::max(pull, -entry.loads[0].force[1]);
      const double t = entry.report.time;
      if (t > 2.0 + 1e-6 && t < 4.0 - 1e-6)
        apart = std::max(apart, entry.loads[0].force.norm());
    }
    const double first = done.at(1.0).loads[0].force[1], second = done.last().loads[0].force[1];
    std::printf(
        "%s: pressed %.3f kN, largest force while apart %.1e N, largest pull %.1e N, pressed "
        "again %.3f kN\n",
        std::string(mechanics::name(kind)).c_str(), first / 1e3, apart, pull, second / 1e3);
    EXPECT_GT(first, 1e5);
    // What has evened its pressure (C.45) touches again a hair early.
    EXPECT_LE(apart, 1e-5 * first);
    EXPECT_LE(pull, 0.0);
    EXPECT_NEAR(second, first, 5e-3 * first); // the same but for the path of slip
    // The tool gets its work back but for friction.
    EXPECT_LT(done.last().report.energy.error(), 5e-3);
    // Apart the part is as it was.
    const Entry& lifted = done.at(3.0);
    EXPECT_NEAR(largest_position(lifted, 2, 1), height, 1e-9 * height);
    EXPECT_NEAR(largest_position(lifted, 2, 0), 10.0, 1e-8 * 10.0);
  }
}

TEST(Separation, LosesNoEnergyWithoutFriction) {
  const FinishedRun done = run(press_and_lift(ElementKind::quad8, contact::Frictionless{}, 0.1));
  ASSERT_EQ(done.status, RunStatus::done);
  const EnergyBalance pressed = done.at(1.0).report.energy;
  const EnergyBalance lifted = done.at(3.0).report.energy;
  std::printf("work in %.6f N mm, left after lifting %.1e of it\n", pressed.external,
              lifted.external / pressed.external);
  // The trapezoidal rule of the work over ten increments of a hardly curved force.
  EXPECT_NEAR(lifted.external, 0.0, 1e-5 * pressed.external);
  EXPECT_NEAR(lifted.contact, 0.0, 1e-12 * pressed.external);
  EXPECT_NEAR(lifted.elastic, 0.0, 1e-9 * pressed.external);
}

} // namespace
} // namespace billet::process::contact_separation_test
