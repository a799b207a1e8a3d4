// The last part of the way solved again on a new mesh. (P.19), (P.20)

#include "geometry/surfaces/analytic_surfaces.h"
#include "process/loop/process.h"
#include "tests/support/remeshed_billet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace billet::process::solved_again_test {
namespace {

TEST(SolvedAgain, LosesNoForceWhereTheMetalFlows) {
  // Balanced where it is, the force would fall by 2 to 5 % and take an increment to come back.
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4}) {
    const FinishedRun done = run(remeshed(billet(kind, 8, 0.3, contact::Sticking{}), every(0.9)));
    ASSERT_EQ(done.status, RunStatus::done);
    ASSERT_GE(done.process->view().state.record.remeshings.size(), 3u);
    double lowest = 1.0;
    for (const RemeshReport& r : done.process->view().state.record.remeshings) {
      EXPECT_GT(r.again, 0);
      EXPECT_TRUE(r.balanced);
      EXPECT_LT(r.force_jump(), 0.01) << "the budget of RM-01";
      for (const Entry& entry : done.recorder.entries)
        if (entry.report.time > r.time && entry.report.time < r.time + 0.2)
          lowest = std::min(lowest, entry.loads[0].force.norm() / r.forces[0].before);
    }
    std::printf("%s: lowest force after a remeshing, of that before: %.4f\n",
                std::string(mechanics::name(kind)).c_str(), lowest);
    EXPECT_GT(lowest, 0.99);
  }
}

TEST(SolvedAgain, KeepsToTheIncrementsOfTheCase) {
  const auto increments = [](double longest, std::vector<double> landings) {
    Scene scene = remeshed(billet(ElementKind::quad8, 6, 0.1, contact::Sticking{}), every(0.9));
    scene.increments.max = longest;
    scene.landing_times = std::move(landings);
    const FinishedRun done = run(std::move(scene));
    EXPECT_EQ(done.status, RunStatus::done);
    const std::span<const RemeshReport> ledger = done.process->view().state.record.remeshings;
    EXPECT_FALSE(ledger.empty());
    return ledger.empty() ? 0 : ledger[0].again;
  };
  const int fine = increments(0.01, {});
  const int landing = increments(
      0.3, {0.62, 0.64, 0.66, 0.68, 0.7, 0.72, 0.74, 0.76, 0.78, 0.8, 0.82, 0.84, 0.86, 0.88});
  std::printf("increments solved again: at most 0.01 s %d, landing each 0.02 s %d\n", fine,
              landing);
  EXPECT_GE(fine, 4);
  EXPECT_GE(landing, 2);
}

/// A square block of 10 mm in plane strain, pressed from above until t = 1, then from the side.
Scene block_turned_over() {
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad8, Vec3::Zero(), Vec3(10, 10, 0), {4, 4, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.reduction = 0.1;
  Scene scene = upsetting_scene(std::move(u));
  scene.tools[0].active_to = 1.0;
  contact::Tool side = moving_tool("side", geometry::make_plane({12, 0, 0}, {-1, 0, 0}), {0, 0, 0});
  side.motion.velocity.reset();
  side.motion.displacement =
      std::array{TimeFunction({{1.0, 0.0}, {3.0, -2.5}}), TimeFunction(0.0), TimeFunction(0.0)};
  scene.tools.push_back(std::move(side));
  scene.touch = {1, 0};
  scene.stages = {{"press", 3.0, {1, 1}, false}};
  return scene;
}

TEST(SolvedAgain, BeginsAfterTheForcesOfAToolThatLeftHaveFaded) {
  // Meshed anew soon after the first die has gone: a way begun before would miss its forces.
  const FinishedRun kept = run(block_turned_over());
  Scene scene = block_turned_over();
  scene.remesh = every(1.0);
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const std::span<const RemeshReport> ledger = done.process->view().state.record.remeshings;
  ASSERT_GE(ledger.size(), 2u);
  EXPECT_LT(ledger[0].time, 1.2);
  EXPECT_GT(ledger[1].again, 0);
  for (const RemeshReport& r : ledger) {
    EXPECT_TRUE(r.balanced);
    EXPECT_LT(r.force_jump(), 0.01) << r.time;
  }
  const double force = done.last().loads[1].force[0], without = kept.last().loads[1].force[0];
  const double height = largest_position(done.last(), 2, 1);
  const double height_without = largest_position(kept.last(), 2, 1);
  std::printf("force from the side %.6g N, without remeshing %.6g; height %.6g mm, %.6g\n", force,
              without, height, height_without);
  EXPECT_NEAR(force, without, 0.01 * without);
  EXPECT_NEAR(height, height_without, 1e-3 * height_without);
}

/// A square block of 10 mm in plane strain, pressed from above faster and faster. A round nose
/// comes from the right, so small that no mesh keeps it out between contact points for long.
Scene block_met_by_a_nose(double radius) {
  constexpr double end = 0.6;
  Upsetting u;
  u.analysis = Analysis::plane_strain;
  u.mesh = mechanics::box_mesh(
      {ElementKind::quad4, Vec3::Zero(), Vec3(10, 10, 0), {8, 16, 1}, {1, 1, 1}});
  u.height = 10.0;
  u.reduction = 0.1 * end;
  Scene scene = upsetting_scene(std::move(u));
  std::vector<std::pair<double, double>> falls{{0.0, 0.0}};
  for (double t = 0.02; t < end; t += 0.02) {
    falls.emplace_back(t, -(0.5 + t) * t);
    scene.landing_times.push_back(t);
  }
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.displacement =
      std::array{TimeFunction(0.0), TimeFunction(std::move(falls)), TimeFunction(0.0)};
  scene.tools.push_back(moving_tool(
      "nose", geometry::make_circle({11.5 + radius, 5.0, 0.0}, radius, false), {-3.0, 0, 0}));
  scene.touch = {0, 0};
  scene.stages[0].tools = {1, 1};
  scene.increments.max = 0.02;
  scene.contact.max_penetration = 0.01;
  scene.remesh = RemeshSettings{};
  scene.remesh->size = scene.remesh->size_min = 2.5;
  return scene;
}

/// Compares how fast the top of the part moves before its mesh is exchanged and after, where no way
/// led to the new mesh.
class SpeedOfTheTop final : public Observer {
public:
  void remeshing(const Run& process) override { before_ = speed(process); }
  void remeshed(const Run& process, const RemeshReport& report) override {
    if (report.again > 0)
      return;
    ++given_up;
    EXPECT_TRUE(report.balanced);
    EXPECT_LT(before_, -1.0);
    EXPECT_NEAR(speed(process), before_, 0.1) << "at t = " << report.time;
  }

  int given_up = 0;

private:
  /// Average of the nodes at the die [mm/s].
  static double speed(const Run& process) {
    constexpr double near = 0.01;
    double top = 0.0;
    for (std::size_t i = 1; i < process.positions().size(); i += 2)
      top = std::max(top, process.positions()[i]);
    double sum = 0.0, number = 0.0;
    for (std::size_t i = 1; i < process.positions().size(); i += 2)
      if (process.positions()[i] > top - near) {
        sum += process.state.velocity[i];
        number += 1.0;
      }
    return sum / number;
  }

  double before_ = 0.0;
};

TEST(SolvedAgain, AWayThatCannotBeGoneLeavesTheVelocitiesOfItsEnd) {
  SpeedOfTheTop top;
  for (const double radius : {0.2, 0.3, 0.4}) {
    Process process(block_met_by_a_nose(radius));
    EXPECT_NE(process.run({&top}), RunStatus::stopped);
  }
  EXPECT_GT(top.given_up, 0) << "this shows nothing";
}

} // namespace
} // namespace billet::process::solved_again_test
