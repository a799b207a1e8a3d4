// Runs stored at every increment and resumed from there: the same bits as the run that went on.

#include "geometry/base/archive.h"
#include "io/case/read_case.h"
#include "io/scene/scene_builder.h"
#include "process/loop/process.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace billet::io::resumed_run_test {
namespace {

using process::CheckpointReason;
using process::IncrementReport;
using process::Process;
using process::Run;
using process::RunStatus;

/// Bytes of an increment, but for clocks.
std::string bytes_of(const Run& process, IncrementReport report) {
  report.wall_time = 0.0;
  ArchiveWriter bytes;
  bytes(report, std::vector<double>(process.state.x.begin(), process.state.x.end()));
  for (const mechanics::IterationRecord& record : report.records)
    bytes(record.iteration, record.residual, record.correction, record.step,
          record.contact_changes);
  if (process.contact() != nullptr)
    for (const contact::ToolLoad& load : process.contact()->loads())
      bytes(load);
  if (process.model.wear.get() != nullptr)
    for (std::size_t t = 0; t < process.tools().size(); ++t)
      if (process.model.wear->map(t))
        bytes(process.model.wear->map(t)->volume());
  for (const process::BlowReport& blow : process.blows())
    bytes(blow);
  return bytes.take();
}

class Recorder final : public process::Observer {
public:
  /// What the run did after each increment, and what it was before each try.
  struct Stored {
    std::size_t after; ///< so many increments
    std::string bytes;
  };
  std::vector<std::string> increments;
  std::vector<Stored> stored;

  void incremented(const Run& process, const IncrementReport& report) override {
    increments.push_back(bytes_of(process, report));
  }
  [[nodiscard]] bool wants_checkpoint(const Run&, CheckpointReason) override { return true; }
  void checkpoint(const Run&, const std::string& bytes) override {
    stored.push_back({increments.size(), bytes});
  }
};

class ResumedRun : public testing::Test {
protected:
  [[nodiscard]] std::unique_ptr<Process> made(const std::string& text) const {
    const Case content = read_case(folder_.file("case.toml", text), {}, {});
    process::Scene scene = build_scene(content, "case.toml").scene;
    return std::make_unique<Process>(std::move(scene));
  }

  /// Goes on from every n-th place at which the run, made by one thread, was stored.
  void expect_same(const std::string& text, std::size_t every, std::size_t threads = 1) const {
    using oneapi::tbb::global_control;
    Recorder whole;
    const std::unique_ptr<Process> reference = made(text);
    {
      const global_control one(global_control::max_allowed_parallelism, 1);
      ASSERT_EQ(reference->run({&whole}), RunStatus::done);
    }
    const global_control limit(global_control::max_allowed_parallelism, threads);
    ASSERT_FALSE(whole.stored.empty());
    std::size_t resumed = 0;
    for (std::size_t i = 0; i < whole.stored.size(); i += every, ++resumed) {
      Recorder rest;
      const std::unique_ptr<Process> process = made(text);
      process->resume(whole.stored[i].bytes);
      ASSERT_EQ(process->run({&rest}), RunStatus::done);
      const std::size_t after = whole.stored[i].after;
      ASSERT_EQ(after + rest.increments.size(), whole.increments.size()) << "stored " << i;
      for (std::size_t k = 0; k < rest.increments.size(); ++k)
        ASSERT_EQ(rest.increments[k] == whole.increments[after + k], true)
            << "stored " << i << ", increment " << after + k + 1;
      EXPECT_EQ(archived(process->view().state.energy), archived(reference->view().state.energy));
      EXPECT_EQ(process->view().state.counters.iterations,
                reference->view().state.counters.iterations);
      EXPECT_EQ(process->view().state.counters.wasted_iterations,
                reference->view().state.counters.wasted_iterations);
      EXPECT_EQ(process->view().state.record.remeshings.size(),
                reference->view().state.record.remeshings.size());
      EXPECT_EQ(process->view().solver_work().systems, reference->view().solver_work().systems);
    }
    std::printf("%zu increments, resumed %zu times, %zu remeshings, %d cut-backs\n",
                whole.increments.size(), resumed, reference->view().state.record.remeshings.size(),
                reference->view().state.counters.cutbacks);
  }

  test::TemporaryFolder folder_;
};

const std::string metal = R"(
[material.metal]
elastic = { young = "200 GPa", poisson = 0.3 }
flow = { law = "swift", K = "700 MPa", eps0 = 0.01, n = 0.2 }
)";

const std::string billet = R"(analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "metal"
mesh = { box = [[0, 0], [5, 8]], cells = [4, 6] }
[[support]]
where = "y = 0"
fix = ["y"]
)" + metal;

const std::string rubbed = billet + R"(
[[tool]]
name = "die"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.1 }
wear = { law = "archard", K = 1e-4, hardness = 700 }
[time]
end = 2
)";

TEST_F(ResumedRun, HasTheHistoryOfSlipAndWear) { expect_same(rubbed, 10); }

const std::string blows = billet + R"(
[[tool]]
name = "die"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { press = { kind = "hammer", direction = [0, -1], energy = "0.2 kJ", velocity = "5 m/s" } }
friction = { law = "tresca", m = 0.2 }
[[stage]]
name = "blow 1"
end = 0.1
[[stage]]
name = "lift"
end = 0.2
unload = true
[[stage]]
name = "blow 2"
end = 0.3
)";

TEST_F(ResumedRun, GoesOnThroughBlowsAndUnloading) { expect_same(blows, 20); }

const std::string driven = billet + R"(
[[tool]]
name = "far"
surface = { plane = { point = [0, 200], normal = [0, -1] } }
motion = { displacement = [[0, 0, 0], [1, 0, -193]] }
friction = { law = "tresca", m = 0.2 }
[[tool]]
name = "force"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { force = { direction = [0, -1], value = [[1.2, 0], [2, 90000]] } }
friction = { law = "tresca", m = 0.2 }
[[stage]]
name = "travel"
end = 1
tools = ["far"]
[[stage]]
name = "back"
end = 1.2
unload = true
[[stage]]
name = "press"
end = 2
tools = ["force"]
)";

const std::string flown = billet + R"(
[[tool]]
name = "die"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { displacement = [[0, 0, 0], [1, 0, -0.5], [1.1, 0, 10], [2, 0, -0.6]] }
friction = { law = "tresca", m = 0.2 }
[time]
end = 2
)";

TEST_F(ResumedRun, CountsTheIterationsOfAFlight) { expect_same(flown, 15); }

TEST_F(ResumedRun, GoesOnWhileALoadDrivesAndAToolComesFromFar) { expect_same(driven, 15); }

const std::string remeshed_in_the_plane = billet + R"(
[[tool]]
name = "die"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { velocity = [0, -1] }
friction = { law = "sticking" }
[remesh]
when = { strain = 0.4 }
[time]
end = 3.5
)";

TEST_F(ResumedRun, GoesOnAfterNewMeshesInThePlane) { expect_same(remeshed_in_the_plane, 10); }

TEST_F(ResumedRun, GoesOnWithTwoThreads) { expect_same(remeshed_in_the_plane, 20, 2); }

const std::string remeshed_in_space = R"(analysis = "3d"
[workpiece]
element = "tet10"
material = "metal"
mesh = { box = [[0, 0, 0], [4, 4, 4]], cells = [2, 2, 2] }
[[support]]
where = "z = 0"
fix = ["z"]
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 0, 4], normal = [0, 0, -1] } }
motion = { velocity = [0, 0, -1] }
friction = { law = "coulomb", mu = 0.2 }
[remesh]
when = { strain = 0.25 }
[time]
end = 1.2
)" + metal;

TEST_F(ResumedRun, GoesOnAfterNewMeshesInSpace) { expect_same(remeshed_in_space, 20); }

using ResumedRunLong = ResumedRun;

TEST_F(ResumedRunLong, IsTheSameFromEveryIncrement) {
  for (const std::string* text :
       {&rubbed, &blows, &driven, &remeshed_in_the_plane, &remeshed_in_space}) {
    expect_same(*text, 1);
    expect_same(*text, 7, 2);
  }
}

TEST_F(ResumedRun, IsTheSameFromOneStateTwice) {
  Recorder whole;
  ASSERT_EQ(made(remeshed_in_the_plane)->run({&whole}), RunStatus::done);
  const std::string stored = whole.stored[whole.stored.size() / 2].bytes;
  Recorder first, second;
  for (Recorder* rest : {&first, &second}) {
    const std::unique_ptr<Process> process = made(remeshed_in_the_plane);
    process->resume(stored);
    ASSERT_EQ(process->run({rest}), RunStatus::done);
  }
  EXPECT_TRUE(first.increments == second.increments);
  EXPECT_FALSE(first.increments.empty());
}

TEST_F(ResumedRun, RefusesBytesOfAnotherSceneOrCutShort) {
  Recorder whole;
  ASSERT_EQ(made(remeshed_in_the_plane)->run({&whole}), RunStatus::done);
  const std::string& stored = whole.stored.front().bytes;
  std::string other = remeshed_in_the_plane;
  other.replace(other.find("cells = [4, 6]"), 14, "cells = [4, 5]");
  EXPECT_THROW(made(other)->resume(stored), Error);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, stored.size() / 2, stored.size() - 1})
    EXPECT_THROW(made(remeshed_in_the_plane)->resume(stored.substr(0, size)), Error) << size;
  EXPECT_THROW(made(remeshed_in_the_plane)->resume(stored + "x"), Error);
}

} // namespace
} // namespace billet::io::resumed_run_test
