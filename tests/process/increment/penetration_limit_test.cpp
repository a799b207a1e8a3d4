// max_penetration is honoured: the report of every increment obeys it, by stiffer penalties or by
// multipliers, and a limit that no pressure can meet ends the run with the reason.

#include "process/increment/penetration_limit.h"
#include "process/loop/process.h"
#include "process/remeshing/remesh.h"
#include "process/stages/stage_start.h"
#include "process/state/model.h"
#include "process/state/run.h"
#include "process/tools/narrow_tools.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

namespace billet::process::penetration_limit_test {
namespace {

/// A block or cylinder of height 15 under a flat die, with so soft a penalty that it shows.
Scene soft_upsetting(ElementKind kind, Analysis analysis) {
  Upsetting u;
  u.mesh = mechanics::box_mesh({kind,
                                Vec3::Zero(),
                                analysis == Analysis::solid ? Vec3(10, 10, 15) : Vec3(10, 15, 0),
                                {3, analysis == Analysis::solid ? 3 : 4, 3},
                                {1, 1, 1}});
  u.analysis = analysis;
  u.friction = contact::Coulomb{0.1};
  u.reduction = 0.05;
  Scene scene = upsetting_scene(std::move(u));
  scene.contact.form = contact::Form::compatible;
  scene.contact.penalty = 0.5;
  scene.increments.first = scene.increments.max = 0.15;
  scene.landing_times = {0.15, 0.3, 0.45, 0.6};
  return scene;
}

double deepest(const FinishedRun& done) {
  double most = 0.0;
  for (const Entry& entry : done.recorder.entries)
    most = std::max(most, entry.report.max_penetration);
  return most;
}

TEST(PenetrationLimit, HoldsInEveryIncrementOfEveryAnalysisByBothMethods) {
  constexpr double limit = 1e-3; // [mm]
  for (const auto& [kind, analysis] : {std::pair{ElementKind::quad8, Analysis::axisymmetric},
                                       {ElementKind::quad4, Analysis::plane_strain},
                                       {ElementKind::hex8, Analysis::solid}}) {
    const FinishedRun loose = run(soft_upsetting(kind, analysis));
    Scene stiff_scene = soft_upsetting(kind, analysis);
    stiff_scene.contact.penalty = 1000.0;
    const FinishedRun stiff = run(std::move(stiff_scene));
    EXPECT_GT(deepest(loose), 3.0 * limit);
    for (const contact::Method method : {contact::Method::penalty, contact::Method::augmented}) {
      Scene scene = soft_upsetting(kind, analysis);
      scene.contact.method = method;
      scene.contact.max_penetration = limit;
      const FinishedRun done = run(std::move(scene));
      ASSERT_EQ(done.status, RunStatus::done);
      const int along = up(analysis);
      double off = 0.0; // force against that of the stiff penalty
      for (const double t : {0.15, 0.3, 0.45, 0.6, 0.75}) {
        ASSERT_EQ(done.at(t).report.time, stiff.at(t).report.time);
        off = std::max(
            off,
            std::abs(done.at(t).loads[0].force[along] / stiff.at(t).loads[0].force[along] - 1.0));
      }
      std::printf("%s, %s: deepest %.2e of %.2e allowed, %.2e without; penalty x %.0f; force "
                  "within %.2g of a stiff penalty's; balance %.1e, without %.1e\n",
                  std::string(mechanics::name(kind)).c_str(),
                  method == contact::Method::penalty ? "penalty" : "augmented", deepest(done),
                  limit, deepest(loose), done.process->view().contact()->state().penalty.trial, off,
                  done.process->view().state.energy.error(),
                  loose.process->view().state.energy.error());
      EXPECT_LE(deepest(done), limit);
      EXPECT_GT(deepest(done), 0.0);
      EXPECT_LT(off, 2e-3);
      // The first increments take the body across yield, where the books miss their share.
      EXPECT_LT(done.process->view().state.energy.error(),
                2.0 * stiff.process->view().state.energy.error() + 1e-3);
    }
  }
}

TEST(PenetrationLimit, AugmentedWithoutALimitTakesThePenetrationFromContactPoints) {
  Scene scene = soft_upsetting(ElementKind::quad8, Analysis::axisymmetric);
  scene.contact.method = contact::Method::augmented;
  scene.contact.penalty = 100.0;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  for (const Entry& entry : done.recorder.entries)
    EXPECT_LE(entry.report.penetration.share_pressed, 1e-6);
}

TEST(PenetrationLimit, HoldsFarBelowTheElementSizeOnAFlatDie) {
  Scene scene = soft_upsetting(ElementKind::quad4, Analysis::plane_strain);
  scene.contact.method = contact::Method::augmented;
  scene.contact.penalty = 100.0;
  scene.contact.max_penetration = 1e-6; // [mm], elements of 3.75 mm
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  EXPECT_LE(deepest(done), 1e-6);
}

TEST(PenetrationLimit, StopsWithTheReasonWhereTheToolPassesBetweenPoints) {
  // The mixed form's corner sinks into the die between its points, whatever presses on them.
  for (const contact::Method method : {contact::Method::penalty, contact::Method::augmented}) {
    Scene scene = billet_scene(ElementKind::quad8, 4, 6, contact::Sticking{}, 0.3);
    scene.contact.method = method;
    scene.contact.max_penetration = 1e-4;
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.status, RunStatus::not_converged);
    ASSERT_EQ(done.recorder.failures.size(), 1u);
    const PostMortem& post = done.recorder.failures[0];
    for (const char* word :
         {"max_penetration = 0.0001", "tool 'die'", "passes between", "compatible"})
      EXPECT_NE(post.reason.find(word), std::string::npos) << word << ": " << post.reason;
    EXPECT_EQ(post.worst_node, -1);
    EXPECT_GT(post.worst_position[0], 5.0) << "near the corner";
    EXPECT_LE(deepest(done), 1e-4); // what was accepted obeys
    EXPECT_GT(done.process->view().state.increment, 0);
  }
}

Scene remeshed_upsetting(const std::optional<double>& size_min) {
  Scene scene = upsetting_scene(billet(ElementKind::quad8, 4, 0.3, contact::Coulomb{0.2}));
  scene.remesh = RemeshSettings{};
  scene.remesh->size_min = size_min;
  return scene;
}

/// Before its first increment, as if elements were 3 long.
void begin(process::Run& run) {
  run.state.mesh.first_side = 3.0;
  start_stage(run, run.scene.stages.front());
  run.model.contact->start(run.state.x, 0.0);
}

TEST(DeepestTool, IsComparedWithTheElementOrTheShortestEdgesAskedFor) {
  process::Run run(remeshed_upsetting(1.0));
  begin(run);
  EXPECT_EQ(run.state.mesh.shortest, 0.0) << "the first mesh is the user's";
  const Index face = 0;
  const double element =
      std::max(run.model.surface->depth(face), 0.7 * run.model.narrow->length(face));
  const auto share_of = [&](double depth, double shortest) {
    run.state.mesh.shortest = shortest;
    run.state.record.deepest_tool = {};
    run.attempt.penetration.relative.depth = depth;
    run.attempt.penetration.relative.face = face;
    note_deepest_tool(run);
    return run.state.record.deepest_tool.share;
  };
  EXPECT_NEAR(share_of(0.5 * element, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(share_of(0.5 * element, 0.5 * element), 0.5, 1e-12);
  EXPECT_NEAR(share_of(0.5 * element, 5.0 * element), 0.1, 1e-12) << "a splinter";
  ASSERT_TRUE(remesh(run, "a test", {}));
  EXPECT_EQ(run.state.mesh.shortest, 1.0);
  process::Run on_defaults(remeshed_upsetting(std::nullopt));
  begin(on_defaults);
  ASSERT_TRUE(remesh(on_defaults, "a test", {}));
  EXPECT_EQ(on_defaults.state.mesh.shortest, 3.0 / 16.0) << "in a zone of contact";
}

} // namespace
} // namespace billet::process::penetration_limit_test
