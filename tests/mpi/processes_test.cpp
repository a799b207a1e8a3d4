// billet-mpi in one, two and four processes, as a user starts it.

#include "tests/app/tables.h"
#include "tests/mpi/launch.h"
#include "tests/support/case_texts.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace billet::test::processes_test {
namespace {

namespace fs = std::filesystem;

/// Pressed between a wall and a ball: contact with Coulomb friction makes the tangent unsymmetric.
const std::string ball_3d = R"(title = "Ball"
analysis = "3d"

[workpiece]
element = "hex8"
material = "metal"
mesh = { box = [[0, 0, 0], [10, 10, 10]], cells = [4, 4, 4] }

[material.metal]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 400, hardening = 500 }

[[support]]
where = "x = 0"
fix = ["x"]

[[support]]
where = "y = 0"
fix = ["y"]

[[support]]
where = "z = 0"
fix = ["z"]

[[tool]]
name = "punch"
surface = { sphere = { centre = [0, 0, 24], radius = 14 } }
motion = { velocity = [0, 0, -1] }
friction = { law = "coulomb", mu = 0.2 }

[time]
end = 0.06
increments = { first = 0.02, max = 0.02 }

[output]
checkpoint_every = 0.01
)";

const std::string plane_coulomb =
    edited(upsetting, {{R"({ law = "tresca", m = 0.08 })", R"({ law = "coulomb", mu = 0.3 })"}});

class Processes : public testing::Test {
protected:
  void write(const std::string& text, const std::string& linear) const {
    write_text(folder_.path() / "case.toml",
               text + "\n[solver]\ntolerance = 1e-9\nlinear = \"" + linear + "\"\n");
  }
  [[nodiscard]] std::vector<std::string> words(const std::string& out) const {
    return {"run", "case.toml", "--quiet", "--threads", "1", "-o", out};
  }
  [[nodiscard]] ResultTable history(const std::string& out) const {
    return read_table(folder_.path() / out / "history.csv");
  }
  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(whole_file(folder_.path() / out / "summary.json"));
  }
  /// Every force and torque of two runs, relative to the largest of its column.
  void expect_same_forces(const std::string& one, const std::string& other) const {
    constexpr double same = 1e-6;
    const ResultTable a = history(one), b = history(other);
    ASSERT_EQ(a.rows.size(), b.rows.size());
    ASSERT_FALSE(a.rows.empty());
    double largest = 0.0;
    for (const std::string& column : a.columns)
      if (column.find("punch.force") == 0)
        for (const double force : a.values(column))
          largest = std::max(largest, std::abs(force));
    ASSERT_GT(largest, 0.0);
    for (const std::string& column : a.columns) {
      if (column.find("punch.force") != 0)
        continue;
      for (std::size_t row = 0; row < a.rows.size(); ++row)
        EXPECT_NEAR(a.value(row, column), b.value(row, column), same * largest)
            << column << " of row " << row << ", " << other;
    }
  }

  TemporaryFolder folder_;
};

TEST_F(Processes, give_the_forces_of_one) {
  const struct {
    std::string name, text, linear;
    int processes;
    std::string method;
  } runs[] = {
      {"tresca", upsetting, "mumps", 2, "mumps-ldlt-gmres"},
      {"plane", plane_coulomb, "mumps", 2, "mumps-ldlt-gmres"},
      {"plane", plane_coulomb, "multigrid", 2, "multigrid"},
      {"space", ball_3d, "mumps", 2, "mumps-ldlt-gmres"},
      {"space", ball_3d, "mumps", 4, "mumps-ldlt-gmres"},
      {"space", ball_3d, "multigrid", 2, "multigrid"},
      {"space", ball_3d, "multigrid", 4, "multigrid"},
      {"short", edited(plane_coulomb, {{"end = 0.1", "end = 0.02"}}), "superlu-dist", 2,
       "superlu-dist"},
  };
  for (const auto& [name, text, linear, processes, method] : runs) {
    const std::string one = name + "-one";
    write(text, "auto");
    if (!fs::exists(folder_.path() / one)) {
      ASSERT_EQ(billet(words(one), folder_.path()).status, 0);
    }
    write(text, linear);
    const std::string out = name + "-" + linear + "-" + std::to_string(processes);
    const Outcome outcome = launch(processes, words(out), folder_.path());
    ASSERT_EQ(outcome.status, 0) << out << ": " << outcome.err;
    expect_same_forces(one, out);
    EXPECT_EQ(summary(out).at("linear_solver").at("last").at("method"), method) << out;
    EXPECT_EQ(summary(out).at("resources").at("processes").size(), std::size_t(processes));
  }
}

TEST_F(Processes, leave_small_systems_to_the_first) {
  write(ball_3d, "auto");
  ASSERT_EQ(billet(words("one"), folder_.path()).status, 0);
  const Outcome outcome = launch(2, words("two"), folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(history("two").without_wall_time(), history("one").without_wall_time());
}

TEST_F(Processes, may_be_one_without_mpiexec) {
  write(ball_3d, "mumps");
  ASSERT_EQ(billet(words("one"), folder_.path()).status, 0);
  Start alone{words("alone"), folder_.path()};
  alone.program = BILLET_MPI_PROGRAM;
  const Outcome outcome = billet(alone);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(history("alone").without_wall_time(), history("one").without_wall_time());
  EXPECT_FALSE(summary("alone").at("resources").contains("processes"));
}

TEST_F(Processes, stop_in_order_and_go_on) {
  const std::string longer =
      edited(ball_3d, {{"end = 0.06\nincrements = { first = 0.02, max = 0.02 }",
                        "end = 0.04\nincrements = { first = 0.005, max = 0.005 }"}});
  write(longer, "mumps");
  ASSERT_EQ(billet(words("one"), folder_.path()).status, 0);
  Program program(launched(2, words("parts"), folder_.path()));
  ASSERT_TRUE(program.wait_until([&] {
    return whole_file(folder_.path() / "parts" / "history.csv").find("\n4,") != std::string::npos;
  }));
  program.signal(SIGUSR1); // which mpiexec hands on
  const Outcome stopped = program.end();
  EXPECT_EQ(stopped.status, 128 + SIGUSR1) << stopped.err;
  EXPECT_EQ(summary("parts").at("status"), "stopped");
  const std::size_t so_far = history("parts").rows.size();
  EXPECT_LT(so_far, history("one").rows.size());
  std::vector<std::string> again = words("parts");
  again.push_back("--resume");
  const Outcome outcome = launch(2, again, folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_same_forces("one", "parts");
}

TEST_F(Processes, end_all_when_the_first_is_killed) {
  write(edited(ball_3d, {{"end = 0.06\nincrements = { first = 0.02, max = 0.02 }",
                          "end = 0.3\nincrements = { first = 0.001, max = 0.001 }"}}),
        "mumps");
  Program program(launched(2, words("killed"), folder_.path()));
  ASSERT_TRUE(
      program.wait_until([&] { return fs::exists(folder_.path() / "killed" / "history.csv"); }));
  const std::vector<pid_t> first = processes_with_rank(0, folder_.path());
  const std::vector<pid_t> second = processes_with_rank(1, folder_.path());
  ASSERT_EQ(first.size(), 1U);
  ASSERT_EQ(second.size(), 1U);
  ::kill(first[0], SIGKILL);
  EXPECT_NE(program.end().status, 0);
  EXPECT_TRUE(processes_with_rank(1, folder_.path()).empty());
}

TEST_F(Processes, keep_the_status_and_say_it_once) {
  write(edited(ball_3d, {{"poisson = 0.3", "poisson = 0.7"}}), "auto");
  const Outcome outcome = launch(4, words("bad"), folder_.path());
  EXPECT_EQ(outcome.status, 3);
  const std::size_t told = outcome.err.find("poisson");
  ASSERT_NE(told, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("poisson", outcome.err.find('\n', told)), std::string::npos)
      << outcome.err;
  EXPECT_EQ(launch(2, {"run", "nowhere.toml"}, folder_.path()).status, 3);
  write(ball_3d, "auto");
  std::vector<std::string> from_nothing = words("nothing");
  from_nothing.push_back("--resume");
  EXPECT_EQ(launch(2, from_nothing, folder_.path()).status, 6);
}

TEST_F(Processes, refuse_what_is_for_one) {
  const Outcome study = launch(2, {"study", "study.toml"}, folder_.path());
  EXPECT_EQ(study.status, 2);
  EXPECT_TRUE(study.says("'study' is for one process: billet study")) << study.err;
  write(ball_3d, "superlu-dist");
  const Outcome one = billet(words("one"), folder_.path());
  EXPECT_EQ(one.status, 3);
  EXPECT_TRUE(one.says("is for several processes")) << one.err;
}

TEST_F(Processes, of_billet_are_refused) {
  write(ball_3d, "auto");
  Start start = launched(2, words("twice"), folder_.path());
  start.words[2] = BILLET_PROGRAM;
  const Outcome outcome = billet(start);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.says("billet-mpi runs in several")) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "twice"));
}

} // namespace
} // namespace billet::test::processes_test
