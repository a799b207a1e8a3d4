// Stages: unloading and springback, tools that come and go, a roll that drags.

#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace billet::process::stages_test {
namespace {

constexpr double height = 15.0;

Scene bar(ElementKind kind, double reduction, const contact::Friction& friction) {
  Upsetting u = bar_upsetting(kind);
  u.friction = friction;
  u.reduction = reduction;
  Scene scene = upsetting_scene(std::move(u));
  const double end = scene.stages[0].end;
  scene.stages.push_back({"spring back", end + 1.0, {0}, true});
  return scene;
}

/// A square block of 10 mm in plane strain, pressed from above.
Scene block(double reduction) {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.reduction = reduction;
  return upsetting_scene(std::move(u));
}

TEST(Unloading, RecoversTheElasticStrainOfABar) {
  // Kirchhoff stress tau leaves the logarithmic strain tau / E behind: h -> h exp(tau / E). The
  // engineer's F h / (A E) agrees to the strain, 1e-3.
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::hex8}) {
    const FinishedRun done = run(bar(kind, 0.2, contact::Frictionless{}));
    ASSERT_EQ(done.status, RunStatus::done);
    const int dim = done.process->view().mesh().dimension();
    const Entry& pressed = done.at(0.2 * height);
    const double h = largest_position(pressed, dim, dim - 1);
    const double force = std::abs(pressed.loads[0].force[dim - 1]);
    const double area = pressed.report.contact_area;
    const double recovered = largest_position(done.last(), dim, dim - 1) - h;
    const double e = std::log(height / h);
    const double tau = (700.0 + 300.0 * e) / (1.0 + 300.0 / 200e3);
    const double exact = h * std::expm1(tau / 200e3);
    std::printf("%s: recovered %.8f mm, exact %.8f, F h / (A E) = %.8f\n",
                std::string(mechanics::name(kind)).c_str(), recovered, exact,
                force * h / (area * 200e3));
    EXPECT_NEAR(recovered, exact, 1e-6 * exact); // Newton's tolerance
    EXPECT_NEAR(recovered, force * h / (area * 200e3), 1e-3 * exact);
    for (const auto& load : done.last().loads)
      EXPECT_EQ(load.force, Vec3::Zero());
    EXPECT_EQ(done.last().report.contact_area, 0.0);
  }
}

TEST(Unloading, LeavesABilletInEquilibriumWithoutTools) {
  const FinishedRun done = run(bar(ElementKind::quad8, 0.2, contact::Coulomb{0.2}));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(done.last().loads[0].force, Vec3::Zero());
  double reaction = 0.0;
  for (const Index a : nodes_at(done.process->view().mesh(), 1, 0.0))
    reaction += done.process->view().state.reactions[as_size(2 * a + 1)];
  const double pressed = done.at(0.2 * height).loads[0].force.norm();
  EXPECT_NEAR(reaction, 0.0, 1e-6 * pressed) << "the symmetry plane carries nothing";
  EXPECT_LT(done.last().report.energy.error(), 5e-3);
  EXPECT_GT(done.last().report.energy.elastic, 0.0) << "residual stresses remain";
}

/// A tool that has let go stays where it was, also for what is said of the run at its end.
TEST(Unloading, LeavesToolsWhereTheyWere) {
  const Scene scene = bar(ElementKind::quad8, 0.2, contact::Frictionless{});
  const FinishedRun done = run(scene);
  ASSERT_EQ(done.status, RunStatus::done);
  const auto& end = done.process->view();
  EXPECT_DOUBLE_EQ(end.tools()[0].motion.translation(end.state.time, end.driven(0)).norm(),
                   scene.tools[0].motion.translation(scene.stages[0].end).norm());
}

TEST(Stages, LetToolsComeAndGo) {
  // A block is pressed from above, then, without the die, from the side.
  Scene scene = block(0.1);
  contact::Tool side = moving_tool("side", geometry::make_plane({12, 0, 0}, {-1, 0, 0}), {0, 0, 0});
  side.motion.velocity.reset();
  side.motion.displacement =
      std::array{TimeFunction({{1.0, 0.0}, {3.0, -2.5}}), TimeFunction(0.0), TimeFunction(0.0)};
  scene.tools.push_back(std::move(side));
  scene.touch = {1, 0};
  scene.stages = {{"from above", 1.0, {1, 0}, false}, {"from the side", 3.0, {0, 1}, false}};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const Entry& first = done.at(1.0);
  EXPECT_GT(first.loads[0].force[1], 1e3);
  EXPECT_EQ(first.loads[1].force, Vec3::Zero());
  EXPECT_EQ(done.last().loads[0].force, Vec3::Zero());
  EXPECT_GT(done.last().loads[1].force[0], 1e3);
  EXPECT_LT(largest_position(done.last(), 2, 0), 9.6) << "pressed from the side";
  EXPECT_GT(largest_position(done.last(), 2, 1), 9.2) << "free to rise";
  EXPECT_LT(done.last().report.energy.error(), 5e-3);
}

TEST(Stages, NameAToolThatLiesInTheWorkpieceWhenItsStageBegins) {
  Scene scene = block(0.02);
  scene.tools.push_back(
      moving_tool("side", geometry::make_plane({7, 0, 0}, {-1, 0, 0}), {0, 0, 0}));
  scene.touch = {1, 0};
  scene.stages = {{"from above", 1.0, {1, 0}, false}, {"from the side", 2.0, {1, 1}, false}};
  const FinishedRun done = run(std::move(scene));
  ASSERT_NE(done.status, RunStatus::done);
  ASSERT_FALSE(done.recorder.failures.empty());
  const std::string& why = done.recorder.failures.back().reason;
  EXPECT_NE(why.find("tool 'side' begins to act inside the workpiece"), std::string::npos) << why;
}

TEST(Stages, LetARollDragAStrip) {
  // A roll of radius 50 presses a strip on a smooth table, then turns by 2 mrad: what it holds goes
  // with it, R times the angle, and no torque is needed but for the way's elasticity.
  constexpr double radius = 50.0, angle = 2e-3, press = 0.01;
  Scene scene = strip_on_table(ElementKind::quad8, 3.0, 12, 4);
  contact::Tool roll =
      roll_above(2.0, radius, TimeFunction({{0, 0}, {1, -press}}), contact::Sticking{});
  // The speed rises from 0 at t = 1 to its value at 1.5: the angle is 0.75 of value times second.
  roll.motion.rotation = geometry::Rotation{roll.reference, Vec3::UnitZ(),
                                            TimeFunction({{1.0, 0.0}, {1.5, angle / 0.75}})};
  scene.tools.push_back(std::move(roll));
  scene.part.contact_faces = faces_on(scene.part.mesh, 1, 2.0);
  scene.stages.push_back({"press and turn", 2.0, {1}, false});
  scene.landing_times = {1.0};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_EQ(done.process->view().model.free_motions, 1);
  double moved = 0.0, count = 0.0;
  for (const Index a : nodes_at(done.process->view().mesh(), 1, 0.0)) {
    moved += done.last().positions[as_size(2 * a)] - done.at(1.0).positions[as_size(2 * a)];
    count += 1.0;
  }
  moved /= count;
  const double torque = done.last().loads[0].torque[2];
  const double normal = done.last().loads[0].force[1];
  std::printf("strip dragged by %.6f mm, R angle = %.6f; torque %.3g N mm, normal force %.4g N\n",
              moved, radius * angle, torque, normal);
  EXPECT_NEAR(moved, radius * angle, 0.01 * radius * angle); // the strip's top is 0.01 below R
  EXPECT_LT(std::abs(torque), 1e-3 * normal * radius);
  EXPECT_GT(normal, 100.0);
}

} // namespace
} // namespace billet::process::stages_test
