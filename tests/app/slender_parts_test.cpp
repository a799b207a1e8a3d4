// Parts a hundred times as long as thick, held by tools alone, and loads as small as they bear; and
// what a run says when its forces hide something.

#include "tests/app/tables.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace billet::test::slender_parts_test {

namespace {

class SlenderParts : public testing::Test {
protected:
  [[nodiscard]] Outcome run(const std::string& text,
                            const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml", "--quiet", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return billet(words, folder_.path());
  }
  [[nodiscard]] ResultTable history() const {
    return read_table(folder_.path() / "out" / "history.csv");
  }
  [[nodiscard]] nlohmann::json energy() const {
    return nlohmann::json::parse(whole_file(folder_.path() / "out/summary.json"))["energy"];
  }
  /// Whether the log, which --quiet does not silence, has a text.
  [[nodiscard]] bool logs(const std::string& text) const {
    return whole_file(folder_.path() / "out" / "run.log").find(text) != std::string::npos;
  }

  TemporaryFolder folder_;
};

/// Half of a strip bent by a punch in its middle on a support, and let go.
const std::string strip = R"(
analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "steel"
mesh = { box = [[0, 0], [60, 0.1]], cells = [60, 1] }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "punch"
surface = { circle = { centre = [0, 3.1], radius = 3 } }
motion = { displacement = [[0, 0, 0], [1, 0, -2], [2, 0, -2]] }
[[tool]]
name = "support"
surface = { circle = { centre = [50, -3], radius = 3 } }
[[stage]]
name = "bend"
end = 1
[[stage]]
name = "let go"
end = 2
unload = true
)";

TEST_F(SlenderParts, AStripBendsOnItsToolsAloneAndComesBack) {
  const Outcome outcome = run(strip);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const auto times = table.values("time");
  const auto bent =
      static_cast<std::size_t>(std::find(times.begin(), times.end(), 1.0) - times.begin());
  ASSERT_LT(bent, times.size());
  const double punch = table.value(bent, "punch.force_y");
  const double support = table.value(bent, "support.force_y");
  const double beam = 3 * 200000 / (1 - 0.09) * 1e-3 / 12 / (50 * 50 * 50) * 2;
  std::printf(
      "punch %.5e, support %.5e, beam %.5e N/mm; left of the energy %.1e\n", punch, support, beam,
      table.value(table.rows.size() - 1, "elastic_energy") / table.value(bent, "elastic_energy"));
  EXPECT_NEAR(punch, -support, 0.01 * punch);
  EXPECT_NEAR(punch, beam, 0.03 * beam) << "rolls are not knives";
  EXPECT_LT(table.value(table.rows.size() - 1, "elastic_energy"),
            1e-6 * table.value(bent, "elastic_energy"));
  EXPECT_LT(energy()["grounding_work"].get<double>(), 2e-3 * table.value(bent, "elastic_energy"));
  EXPECT_FALSE(logs("grounding"));
}

TEST_F(SlenderParts, AForceBendsAStripAsFarAsItDoesAStiffOne) {
  std::string driven = strip;
  const auto replace = [&](const std::string& what, const std::string& with) {
    driven.replace(driven.find(what), what.size(), with);
  };
  replace(
      "motion = { displacement = [[0, 0, 0], [1, 0, -2], [2, 0, -2]] }",
      "touch = true\nmotion = { force = { direction = [0, -1], value = [[0, 0], [1, 8e-4]] } }");
  replace("[[stage]]\nname = \"let go\"\nend = 2\nunload = true\n", "");
  const Outcome outcome = run(driven);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  const double travel = -table.value(last, "punch.displacement_y");
  const double beam = 8e-4 * (50 * 50 * 50) / (3 * 200000 / (1 - 0.09) * 1e-3 / 12);
  std::printf("travel %.4f, beam %.4f mm\n", travel, beam);
  EXPECT_NEAR(table.value(last, "support.force_y"), -8e-4, 0.01 * 8e-4);
  EXPECT_NEAR(travel, beam, 0.03 * beam);
}

TEST_F(SlenderParts, AFoilThatIsClampedComesBackWhenItIsLetGo) {
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex20", material = "steel", mesh = { box = [[0, 0, 0], [100, 4, 0.1]], cells = [20, 1, 1] } }
[material.steel]
elastic = { young = 210000, poisson = 0.3 }
[[support]]
where = "x = 0"
fix = ["x", "z"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "punch"
surface = { cylinder = { point = [90, 0, 5.1], axis = [0, 1, 0], radius = 5 } }
motion = { displacement = [[0, 0, 0, 0], [1, 0, 0, -10]] }
[[stage]]
name = "bend"
end = 1
[[stage]]
name = "let go"
end = 2
unload = true
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::vector<double> elastic = table.values("elastic_energy");
  EXPECT_LT(elastic.back(), 1e-9 * *std::max_element(elastic.begin(), elastic.end()));
}

TEST_F(SlenderParts, ALittleLoadIsALoad) {
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "tet10", material = "steel", mesh = { box = [[0, 0, 0], [1000, 20, 1]], cells = [50, 1, 1] } }
[material.steel]
elastic = { young = 210000, poisson = 0.3 }
[[support]]
where = "x = 0"
fix = ["x", "y", "z"]
[[load]]
where = "x = 1000"
traction = [0, 0, -0.001]
amplitude = [[0, 0], [1, 1]]
[time]
end = 1
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double force = 0.001 * 20;
  const double sag = force * 1e9 / (3 * 210000 * 20 / 12.0); // Bernoulli
  const double work = energy()["external_work"].get<double>();
  std::printf("work %.5f, of a beam %.5f N mm\n", work, 0.5 * force * sag);
  EXPECT_NEAR(work, 0.5 * force * sag, 0.06 * work) << "a plate more than a beam at its clamp";
}

/// A disk between flat dies; what differs is replaced.
const std::string disk = R"(
analysis = "axisymmetric"
workpiece = { element = "quad4", material = "steel", mesh = { box = [[0, 0], [30, 1]], cells = [60, 3] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 550, eps0 = 0.005, n = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "upper"
surface = { plane = { point = [0, 1], normal = [0, -1] } }
motion = { displacement = [[0, 0, 0], [1, 0, -0.02], [2, 0, -0.02]] }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name = "lower"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
friction = { law = "coulomb", mu = 0.1 }
[[stage]]
name = "coin"
end = 1
[[stage]]
name = "let go"
end = 2
unload = true
)";

TEST_F(SlenderParts, AFlatDiskThatWasCoinedStaysFlatWhenItIsLetGo) {
  ASSERT_EQ(run(disk).status, 0);
  EXPECT_FALSE(logs("plastic work was done while forces"));
  const ResultTable let_go = history();
  // Just as it does when the dies open.
  std::string opened = disk;
  opened.replace(opened.find("[2, 0, -0.02]"), 13, "[2, 0, 0.02]");
  opened.replace(opened.find("unload = true"), 13, "");
  ASSERT_EQ(run(opened).status, 0);
  const ResultTable open = history();
  const auto at_end = [](const ResultTable& table, const std::string& column) {
    return table.value(table.rows.size() - 1, column);
  };
  std::printf("strain let go %.4f, opened %.4f; elastic energy %.1f, %.1f N mm\n",
              at_end(let_go, "max_plastic_strain"), at_end(open, "max_plastic_strain"),
              at_end(let_go, "elastic_energy"), at_end(open, "elastic_energy"));
  EXPECT_NEAR(at_end(let_go, "max_plastic_strain"), at_end(open, "max_plastic_strain"), 2e-3);
  EXPECT_EQ(at_end(let_go, "upper.force_y"), 0.0);
}

TEST_F(SlenderParts, AFlatDiskThatFoldsUnderFadingForcesIsTold) {
  // A stage without tools that is no unloading: their forces fade in a twentieth of it.
  std::string left = disk;
  left.replace(left.find("unload = true"), 13, "tools = [\"far\"]");
  left.insert(left.find("[[stage]]"), R"([[tool]]
name = "far"
surface = { plane = { point = [0, 100], normal = [0, -1] } }

)");
  (void)run(left);
  EXPECT_TRUE(logs("end the stage before with unload"))
      << whole_file(folder_.path() / "out/run.log");
}

TEST_F(SlenderParts, AToolNarrowerThanContactPointsAreApartIsTold) {
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad4", material = "steel", mesh = { box = [[0, 0], [10, 1]], cells = [20, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "perfect", yield = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "needle"
surface = { circle = { centre = [0, 1.1], radius = 0.1 } }
motion = { velocity = [0, -1] }
[time]
end = 1
)");
  // On the axis it would have to press on a point.
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  EXPECT_TRUE(logs("tool 'needle' lies 0.05")) << outcome.err;
  EXPECT_TRUE(logs("no contact point meets it"));
}

TEST_F(SlenderParts, BricksInSingleFileAreTold) {
  const std::string bar = R"(
analysis = "3d"
workpiece = { element = "hex20", material = "steel", mesh = { box = [[0, 0, 0], [100, 4, 2]], cells = [10, 1, 1] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "x = 0"
fix = ["x", "y", "z"]
[[support]]
where = "x = 100"
move = { x = [[0, 0], [1, 0.01]] }
[time]
end = 1
)";
  (void)run(bar);
  EXPECT_TRUE(logs("10 element(s) of hex20, the first is 0, lie in single file"));
  std::string wider = bar;
  wider.replace(wider.find("[10, 1, 1]"), 10, "[10, 2, 1]");
  ASSERT_EQ(run(wider).status, 0);
  EXPECT_FALSE(logs("single file"));
}

TEST_F(SlenderParts, TheCornerOfAForceIsLandedOn) {
  const Outcome outcome = run(R"(
analysis = "axisymmetric"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [5, 10]], cells = [2, 4] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 550, eps0 = 0.005, n = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "press"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = { force = { direction = [0, -1], value = [[0, 0], [0.4567, 40000], [1, 0]] } }
touch = true
[time]
end = 1
increments = { first = 0.05, max = 0.1 }
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<double> force = history().values("press.force_y");
  EXPECT_NEAR(*std::max_element(force.begin(), force.end()), 40000, 0.1);
}

TEST_F(SlenderParts, WeightThatIsThereAtOnceLosesNoEnergy) {
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex20", material = "steel", mesh = { box = [[0, 0, 0], [10, 10, 10]], cells = [2, 2, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "z = 0"
fix = ["x", "y", "z"]
[[load]]
where = "all"
body_force = [0, 0, -1]
[time]
end = 1
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_LT(energy()["relative_error"].get<double>(), 1e-3);
}

// The forces of the tools fade in their directions: the sheet between them may be about to turn
// over, and the run stopped at 1.16 of 2 s.
TEST_F(SlenderParts, AThinSheetWithoutSupportsSpringsBack) {
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "s", mesh = { box = [[-30, 0], [30, 0.2]], cells = [60, 2] } }
[material.s]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 500, eps0 = 0.002, n = 0.15 }
[[tool]]
name = "punch"
surface = { circle = { centre = [0, 2.2], radius = 2 } }
motion = { displacement = [[0, 0, 0], [1, 0, -15]] }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name = "right"
surface = { circle = { centre = [20, -2], radius = 2 } }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name = "left"
surface = { circle = { centre = [-20, -2], radius = 2 } }
friction = { law = "coulomb", mu = 0.1 }
[[stage]]
name = "bend"
end = 1
[[stage]]
name = "let go"
end = 2
unload = true
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  constexpr double supported = 0.08245; // twice that of the half of it on a support
  EXPECT_NEAR(energy()["elastic_energy"].get<double>(), supported, 2e-3 * supported);
}

// While tools draw back, rows of points part at once: 990 increments, halved and doubled in turn.
TEST_F(SlenderParts, AStripOneBrickWideIsLetGoInFewIncrements) {
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex8", material = "s", mesh = { box = [[0, 0, 0], [25, 1, 1]], cells = [40, 1, 3] } }
[material.s]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 500, eps0 = 0.01, n = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "y = 1"
fix = ["y"]
[[tool]]
name = "punch"
surface = { cylinder = { point = [0, 0, 4], axis = [0, 1, 0], radius = 3 } }
motion = { displacement = [[0, 0, 0, 0], [1, 0, 0, -8]] }
friction = { law = "coulomb", mu = 0.1 }
[[tool]]
name = "roll"
surface = { cylinder = { point = [15, 0, -2], axis = [0, 1, 0], radius = 2 } }
friction = { law = "coulomb", mu = 0.1 }
[[stage]]
name = "bend"
end = 1
[[stage]]
name = "let go"
end = 2
unload = true
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_LT(history().rows.size(), 200u);
  EXPECT_NEAR(energy()["elastic_energy"].get<double>(), 0.12194, 1e-4);
}

} // namespace
} // namespace billet::test::slender_parts_test
