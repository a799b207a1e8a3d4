// Early increments in which the load curve bends: gone in parts, so that no work is missed.

#include "process/increment/bent_increment.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::process::bent_increment_test {
namespace {

TEST(BentIncrement, EndsWhereTheLoadCurveBends) {
  // A force of 1 that is whole after a quarter of a way of 1: work 0.875.
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, 0.875), 0.25);
  // One that begins after three quarters: work 0.125.
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, 0.125), 0.75);
}

TEST(BentIncrement, GivesBothPartsSomething) {
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, 1.2), 0.125) << "the force fell again";
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, 0.499), 0.125);
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, 0.0), 0.875) << "a tool that hardly touches";
  EXPECT_DOUBLE_EQ(bend_from_nothing(0.5, -1.0), 0.875);
}

TEST(BentIncrement, DoesNotFollowRounding) {
  EXPECT_EQ(bend_from_nothing(0.5, 0.833), bend_from_nothing(0.5, std::nextafter(0.833, 1.0)));
  EXPECT_EQ(bend_from_nothing(0.5, 0.833), 21.0 / 64.0);
}

/// Hardens as a low-carbon steel does.
const mechanics::Material steel{{210e3, 0.3}, mechanics::Swift{740.0, 0.01, 0.2}};

/// Upsetting of it by 30 %.
///
/// @param increments  that it is to take; none: the program's own
Scene upset(ElementKind kind,
            Analysis analysis,
            const contact::Friction& friction,
            std::optional<int> increments) {
  Upsetting u;
  u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3(5, 7.5, 0), {4, 6, 1}, {1, 1, 1}});
  u.analysis = analysis;
  u.height = 7.5;
  u.friction = friction;
  u.material = steel;
  u.reduction = 0.3;
  Scene scene = upsetting_scene(std::move(u));
  if (increments)
    scene.increments.first = scene.increments.max = scene.stages[0].end / *increments;
  return scene;
}

void expect_all_work(const std::string& name, Scene scene) {
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const EnergyBalance& energy = done.process->view().state.energy;
  std::printf("%s: %.3f %% missed in %d increments\n", name.c_str(),
              100.0 * energy.missing() / energy.scale(), done.process->view().state.increment);
  EXPECT_LT(energy.error(), 1e-3) << name;
}

TEST(BentIncrement, TheWorkOfARunIsRightWhateverItsFirstIncrement) {
  const contact::Tresca some{0.3, {}};
  for (const int increments : {25, 50})
    expect_all_work(std::to_string(increments) + " increments",
                    upset(ElementKind::quad8, Analysis::axisymmetric, some, increments));
  expect_all_work("usual increments",
                  upset(ElementKind::quad8, Analysis::axisymmetric, some, std::nullopt));
  expect_all_work("quad4, sliding freely",
                  upset(ElementKind::quad4, Analysis::axisymmetric, contact::Frictionless{}, 25));
  expect_all_work("plane strain, sticking",
                  upset(ElementKind::quad4, Analysis::plane_strain, contact::Sticking{}, 25));
}

TEST(BentIncrement, SoIsThatOfADieThatComesToTouchWithinIt) {
  for (const double share : {0.2, 0.5, 0.8}) {
    Scene scene = upset(ElementKind::quad4, Analysis::axisymmetric, contact::Tresca{0.3, {}}, 50);
    const double way = share * *scene.increments.first;
    scene.touch = {0};
    scene.tools[0].surface = geometry::make_plane({0, 7.5 + way, 0}, {0, -1, 0});
    expect_all_work(std::to_string(share) + " through air", std::move(scene));
  }
}

TEST(BentIncrement, WhereContactOnlyBeginsIncrementsStayWhole) {
  // A cylinder is pressed into a wide block: its force grows all the way.
  Upsetting u;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(40, 20, 0), {16, 8, 1}, {1, 1, 1}});
  u.analysis = Analysis::plane_strain;
  u.height = 20.0;
  u.reduction = 0.05;
  u.material = steel;
  Scene scene = upsetting_scene(std::move(u));
  scene.tools[0].surface = geometry::make_circle({0, 25.0, 0}, 5.0, false);
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::done);
  for (const Entry& entry : done.recorder.entries)
    for (const std::string& event : entry.report.events)
      EXPECT_EQ(event.find("in two parts"), std::string::npos) << event;
}

TEST(BentIncrement, TheIncrementsAfterItAreAsLongAsWithoutIt) {
  const FinishedRun done =
      run(upset(ElementKind::quad4, Analysis::axisymmetric, contact::Frictionless{}, std::nullopt));
  const double usual = done.process->view().scene.stages[0].end / 100.0;
  const std::vector<Entry>& entries = done.recorder.entries;
  const auto whole = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
    return entry.report.time > 0.999 * usual;
  });
  ASSERT_NE(whole, entries.end());
  EXPECT_GT(whole - entries.begin(), 0) << "it is gone in parts";
  EXPECT_NEAR(whole->report.time, usual, 1e-9 * usual);
  EXPECT_NEAR((whole + 1)->report.dt, 1.5 * usual, 1e-9 * usual) << "it was easy";
  EXPECT_GT(done.process->view().state.counters.wasted_iterations, 0);
  ASSERT_FALSE(entries[0].report.events.empty());
  EXPECT_NE(entries[0].report.events[0].find("in two parts"), std::string::npos)
      << entries[0].report.events[0];
}

TEST(BentIncrement, AnElasticPartIsPressedInWholeIncrements) {
  Scene scene = upset(ElementKind::quad8, Analysis::axisymmetric, contact::Frictionless{}, 25);
  scene.material = elastic_body(210e3, 0.3);
  scene.stages[0].end = 0.075;
  scene.increments.first = scene.increments.max = 0.003;
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.process->view().state.counters.cutbacks, 0);
  EXPECT_LT(done.process->view().state.energy.error(), 1e-3);
}

} // namespace
} // namespace billet::process::bent_increment_test
