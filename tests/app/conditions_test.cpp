// What holds and loads the part: told by check, and by a run that nothing holds.

#include "tests/app/case_run.h"
#include "tests/support/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

namespace billet::test::conditions_test {

namespace {

/// A block between a foot without friction and a plane tool, pushed to the side.
const std::string pushed = R"(analysis = "plane-strain"
[workpiece]
element = "quad4"
material = "m"
mesh = { box = [[0, 0], [10, 5]], cells = [4, 4] }
[material.m]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "swift", K = 500, eps0 = 0.01, n = 0.2 }
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 5], normal = [0, -1] } }
motion = { velocity = [0, -0.5] }
[[load]]
where = "x = 10"
traction = [1, 0]
amplitude = [[0, 0], [1, 1]]
[time]
end = 1
)";

class Conditions : public CaseRun {};

TEST_F(Conditions, AreListedByCheck) {
  write_text(folder_.path() / "case.toml", pushed);
  const Outcome check = billet({"check", "case.toml"}, folder_.path());
  EXPECT_TRUE(check.prints("support \"y = 0\": 5 node(s) held in y\n")) << check.out;
  EXPECT_TRUE(
      check.prints("load \"x = 10\": 4 face(s), 5 mm long, a force of (5, 0, 0) N/mm in all, "
                   "times its amplitude\n"))
      << check.out;
}

TEST_F(Conditions, ThatDoNotHoldThePartEndTheRun) {
  // It went on in ever more increments, 866 mm away after 7440 of them.
  const Outcome free = run(pushed);
  EXPECT_EQ(free.status, 5) << free.err;
  EXPECT_NE(free.err.find("moves away freely"), std::string::npos) << free.err;
  EXPECT_NE(free.err.find("[free-part]"), std::string::npos) << free.err;
  EXPECT_LT(history().rows.size(), 50U);
}

/// A block upset by half whose flow curve ends at a strain.
std::string upset(double last_strain) {
  std::string text = pushed.substr(0, pushed.find("flow"));
  text +=
      fmt::format("flow = {{ law = \"table\", points = [[0, 200], [{}, 400]] }}\n", last_strain);
  return text + R"([[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 5], normal = [0, -1] } }
motion = { velocity = [0, -2.5] }
[time]
end = 1
)";
}

TEST_F(Conditions, OfStrainBeyondATableAreTold) {
  const Outcome inside = run(upset(1.0));
  EXPECT_EQ(inside.status, 0) << inside.err;
  EXPECT_EQ(inside.err.find("[material-range]"), std::string::npos) << inside.err;
  const Outcome beyond = run(upset(0.4));
  EXPECT_NE(beyond.err.find("[material-range] 100 % of the part has plastic strains above 0.4"),
            std::string::npos)
      << beyond.err;
}

/// A strip 10 x 5 between a foot and a grip.
std::string between_grips(const std::string& grip, const std::string& load) {
  return R"(analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "m"
mesh = { box = [[0, 0], [10, 5]], cells = [4, 2] }
[material.m]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
name = "foot"
where = "y = 0"
fix = ["y"]
)" + grip +
         load + "[time]\nend = 2\n";
}

TEST_F(Conditions, WithANameTellTheirForces) {
  const Outcome done = run(between_grips(
      "[[support]]\nname = \"grip\"\nwhere = \"y = 5\"\nmove = { y = [[0, 0], [2, 0.005]] }\n",
      ""));
  ASSERT_EQ(done.status, 0) << done.err;
  const ResultTable table = history();
  const double stiffness = 200e3 / (1.0 - 0.3 * 0.3); // of plane strain
  const double force = stiffness * 10.0 * 1e-3;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double share = table.value(row, "time") / 2.0;
    EXPECT_NEAR(table.value(row, "grip.force_y"), -share * force, 2e-3 * force);
    EXPECT_NEAR(table.value(row, "foot.force_y"), share * force, 2e-3 * force);
    EXPECT_EQ(table.value(row, "grip.force_x"), 0.0);
  }
  EXPECT_NEAR(summary()["supports"]["foot"]["force"][1], force, 2e-3 * force);
}

TEST_F(Conditions, KeepTheirNamesOnNewMeshes) {
  std::string text = upset(1.0);
  text.replace(text.find("quad4"), 5, "tri6");
  text.replace(text.find("[[support]]"), 11, "[[support]]\nname = \"middle\"");
  const Outcome done = run(text + "[remesh]\nwhen = { interval = 0.3 }\n");
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_GE(summary()["remeshings"]["number"], 2);
  const ResultTable table = history();
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    ASSERT_EQ(table.rows[row].size(), table.columns.size()) << row;
  EXPECT_NE(table.columns.end(),
            std::find(table.columns.begin(), table.columns.end(), "middle.force_x"));
  EXPECT_TRUE(summary()["supports"].contains("middle"));
}

TEST_F(Conditions, CarryAWeightThatComesAndGoes) {
  const Outcome done = run(between_grips(
      "",
      "[[load]]\nwhere = \"all\"\nbody_force = [0, -2]\namplitude = [[0, 0], [1, 1], [2, 0]]\n"));
  ASSERT_EQ(done.status, 0) << done.err;
  const ResultTable table = history();
  double largest = 0.0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double time = table.value(row, "time");
    const double weight = 100.0 * std::min(time, 2.0 - time);
    EXPECT_NEAR(table.value(row, "foot.force_y"), -weight, 1e-4 * 100.0) << time;
    largest = std::max(largest, weight);
  }
  EXPECT_GT(largest, 97.0);
}

TEST_F(Conditions, OfAFrameThatServesAsAMeshAreTold) {
  ASSERT_EQ(run(upset(1.0)).status, 0);
  std::filesystem::path frame;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "out" / "frames"))
    if (entry.path().filename().string().starts_with("workpiece"))
      frame = std::max(frame, entry.path());
  ASSERT_FALSE(frame.empty());
  std::filesystem::copy(frame, folder_.path() / "shape.vtu");
  std::string next = upset(1.0);
  const std::string box = "{ box = [[0, 0], [10, 5]], cells = [4, 4] }";
  next.replace(next.find(box), box.size(), "{ file = \"shape.vtu\" }");
  write_text(folder_.path() / "next.toml", next);
  const Outcome told = billet({"check", "next.toml"}, folder_.path());
  EXPECT_TRUE(told.prints("[frame-as-mesh]")) << told.out << told.err;
  write_text(folder_.path() / "next.toml", "units = \"m-N-s-Pa-degC\"\n" + next);
  const Outcome refused = billet({"check", "next.toml"}, folder_.path());
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.err.find("it is a frame of results in mm-N-s-MPa-degC, the case is in"),
            std::string::npos)
      << refused.err;
}

TEST_F(Conditions, HaveNamesOfTheirOwn) {
  const std::string grip = "[[support]]\nname = \"foot\"\nwhere = \"y = 5\"\nfix = [\"y\"]\n";
  const Outcome twice = run(between_grips(grip, ""));
  EXPECT_EQ(twice.status, 3);
  EXPECT_NE(twice.err.find("there is a support \"foot\" already"), std::string::npos) << twice.err;
  const Outcome of_tool = run(between_grips(
      "[[tool]]\nname = \"foot\"\nsurface = { plane = { point = [0, 5], normal = [0, -1] } }\n",
      ""));
  EXPECT_EQ(of_tool.status, 3);
  EXPECT_NE(of_tool.err.find("there is a tool \"foot\" already"), std::string::npos) << of_tool.err;
}

} // namespace

} // namespace billet::test::conditions_test
