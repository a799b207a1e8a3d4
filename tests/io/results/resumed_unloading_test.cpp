// Runs that are resumed in or after a stage that unloads, with another end of it; and new meshes
// that are made there.

#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/scene/scene_builder.h"
#include "process/loop/process.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace billet::io::resumed_unloading_test {
namespace {

using process::CheckpointReason;
using process::Process;
using process::Run;
using process::RunStatus;

class Recorder final : public process::Observer {
public:
  struct Stored {
    double time;
    std::string bytes;
  };
  std::vector<Stored> stored;
  double deepest = 0.0; ///< penetration from a time on [mm]
  double from = HUGE_VAL;

  void incremented(const Run& run, const process::IncrementReport& /*report*/) override {
    if (run.state.time > from)
      deepest = std::max(deepest, run.attempt.penetration.bound);
  }
  [[nodiscard]] bool wants_checkpoint(const Run&, CheckpointReason) override { return true; }
  void checkpoint(const Run& run, const std::string& bytes) override {
    stored.push_back({run.state.time, bytes});
  }
};

class Unloading : public testing::Test {
protected:
  [[nodiscard]] std::unique_ptr<Process> made(const std::string& text) const {
    const Case content = read_case(folder_.file("case.toml", text), {}, {});
    return std::make_unique<Process>(build_scene(content, "case.toml").scene);
  }
  [[nodiscard]] static double force(const Process& process) {
    return process.view().contact()->loads()[0].force.norm();
  }

  test::TemporaryFolder folder_;
};

const std::string metal_on_planes = R"(
[material.metal]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
)";

std::string disk(double end) {
  return fmt::format(R"(analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "metal"
mesh = {{ box = [[0, 0], [10, 5]], cells = [4, 2] }}
[[tool]]
name = "die"
surface = {{ plane = {{ point = [0, 5], normal = [0, -1] }} }}
motion = {{ velocity = [0, -1] }}
friction = {{ law = "coulomb", mu = 0.1 }}
[[stage]]
name = "press"
end = 0.2
[[stage]]
name = "off"
end = {}
unload = true
)",
                     end) +
         metal_on_planes;
}

TEST_F(Unloading, StaysDoneIfItsStageIsProlonged) {
  Recorder whole;
  const std::unique_ptr<Process> done = made(disk(0.3));
  ASSERT_EQ(done->run({&whole}), RunStatus::done);
  const std::unique_ptr<Process> prolonged = made(disk(0.4));
  prolonged->resume(whole.stored.back().bytes);
  Recorder rest;
  ASSERT_EQ(prolonged->run({&rest}), RunStatus::done);
  EXPECT_EQ(prolonged->view().state.time, 0.4);
  EXPECT_EQ(force(*prolonged), 0.0);
  const auto& before = done->view().state.x;
  const auto& after = prolonged->view().state.x;
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], before[i], 1e-9) << i; // the die would have gone on by 0.1 mm
}

TEST_F(Unloading, IsDoneByAnEarlierEnd) {
  Recorder whole;
  const std::unique_ptr<Process> done = made(disk(0.3));
  ASSERT_EQ(done->run({&whole}), RunStatus::done);
  const auto under_way =
      std::find_if(whole.stored.begin(), whole.stored.end(),
                   [](const Recorder::Stored& stored) { return stored.time > 0.22; });
  ASSERT_NE(under_way, whole.stored.end());
  ASSERT_LT(under_way->time, 0.25);
  const std::unique_ptr<Process> hastened = made(disk(0.25));
  hastened->resume(under_way->bytes);
  Recorder rest;
  ASSERT_EQ(hastened->run({&rest}), RunStatus::done);
  EXPECT_EQ(force(*hastened), 0.0);
  EXPECT_NEAR(hastened->view().state.energy.elastic, done->view().state.energy.elastic,
              1e-3 * done->view().state.energy.elastic);
}

TEST_F(Unloading, IsNotDoneWhereItsStageEndsAtOnce) {
  Recorder whole;
  ASSERT_EQ(made(disk(0.3))->run({&whole}), RunStatus::done);
  const auto under_way =
      std::find_if(whole.stored.begin(), whole.stored.end(),
                   [](const Recorder::Stored& stored) { return stored.time > 0.22; });
  ASSERT_NE(under_way, whole.stored.end());
  EXPECT_THROW(made(disk(under_way->time))->resume(under_way->bytes), Error);
}

/// A punch with a sharp edge that is drawn back and presses again.
std::string twice(double interval) {
  return fmt::format(R"(analysis = "plane-strain"
[workpiece]
element = "tri6"
material = "metal"
mesh = {{ box = [[0, 0], [10, 5]], cells = [10, 5] }}
[[tool]]
name = "punch"
surface = {{ points = [[-1, 5], [3, 5], [3, 9]] }}
motion = {{ displacement = [[0, 0, 0], [1, 0, -0.3], [2, 0, -0.3], [3, 0, -0.6]] }}
[remesh]
when = {{ interval = {} }}
size = {{ default = 1 }}
[[stage]]
name = "press"
end = 1
[[stage]]
name = "off"
end = 2
unload = true
[[stage]]
name = "again"
end = 2.4
)",
                     interval) +
         metal_on_planes;
}

TEST_F(Unloading, LeavesAToolItsCornersOnANewMesh) {
  Recorder with, without;
  with.from = without.from = 2.1;
  const std::unique_ptr<Process> anew = made(twice(1.5)), old = made(twice(50.0));
  ASSERT_EQ(anew->run({&with}), RunStatus::done);
  ASSERT_EQ(old->run({&without}), RunStatus::done);
  const auto& meshes = anew->view().state.record.remeshings;
  ASSERT_TRUE(
      std::any_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh.time == 2.0; }));
  EXPECT_LT(with.deepest, 5.0 * without.deepest); // it was 80 times as deep without corners
  EXPECT_NEAR(force(*anew), force(*old), 0.02 * force(*old));
  // A mesh after that maps what the corners know.
  const std::unique_ptr<Process> again = made(twice(0.99));
  Recorder any;
  EXPECT_EQ(again->run({&any}), RunStatus::done);
}

} // namespace
} // namespace billet::io::resumed_unloading_test
