// Tools that a load drives and that leave, or have nothing left to do; and the work of slides that
// turn within an increment.

#include "tests/app/tables.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace billet::test::leaving_tools_test {

namespace {

class LeavingTools : public testing::Test {
protected:
  [[nodiscard]] Outcome run(const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    return billet({"run", "case.toml", "--quiet", "-o", "out"}, folder_.path());
  }
  [[nodiscard]] ResultTable history() const {
    return read_table(folder_.path() / "out" / "history.csv");
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(whole_file(folder_.path() / "out/summary.json"));
  }

  TemporaryFolder folder_;
};

/// A loose billet of 10 x 10 between an anvil and a tool that `motion` drives; then both leave. A
/// block on the anvil afterwards shows where it is.
std::string on_anvil(const std::string& motion) {
  return R"(
analysis = "axisymmetric"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [10, 10]], cells = [4, 4] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "voce", yield = 200, saturation = 500, rate = 5 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "ram"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = )" +
         motion + R"(
touch = true
friction = { law = "coulomb", mu = 0.2 }
[[tool]]
name = "anvil"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
friction = { law = "coulomb", mu = 0.2 }
[[stage]]
name = "press"
end = 0.1
[[stage]]
name = "leave"
end = 0.2
unload = true
[[stage]]
name = "press again"
end = 0.3
)";
}

TEST_F(LeavingTools, AHammeredBilletStaysOnItsAnvil) {
  const Outcome outcome = run(on_anvil(
      R"({ press = { kind = "hammer", direction = [0, -1], energy = 100000, velocity = 5000 } })"));
  ASSERT_EQ(outcome.status, 0) << outcome.err; // it was off the anvil by 14, the next blow stopped
  const nlohmann::json blows = summary()["blows"];
  ASSERT_EQ(blows.size(), 2u) << "none while tools leave";
  const std::vector<double> volume = history().values("volume");
  EXPECT_NEAR(volume.back(), volume.front(), 1e-2 * volume.front());
  EXPECT_LT(summary()["energy"]["relative_error"].get<double>(), 0.005);
}

TEST_F(LeavingTools, ABilletThatAForcePressedStaysOnItsAnvil) {
  const Outcome outcome = run(on_anvil("{ force = { direction = [0, -1], value = [[0, 0], [0.1, "
                                       "150000], [0.2, 150000], [0.3, 160000]] } }"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(std::abs(history().values("anvil.force_y").back()), 160000, 200);
}

TEST_F(LeavingTools, TheRestOfAStageAfterABlowComesToAnEnd) {
  // Nothing moves after the blow: the whole rest was tried at once, refused, and tried again.
  const Outcome outcome = run(R"(
analysis = "3d"
workpiece = { element = "hex8", material = "steel", mesh = { box = [[0, 0, 0], [10, 10, 10]], cells = [2, 2, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "voce", yield = 200, saturation = 500, rate = 5 }
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
name = "ram"
surface = { plane = { point = [0, 0, 10], normal = [0, 0, -1] } }
motion = { press = { kind = "hammer", direction = [0, 0, -1], energy = 20000, velocity = 5000 } }
[[stage]]
name = "blow"
end = 0.1
[[stage]]
name = "lift"
end = 0.2
unload = true
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary()["blows"].size(), 1u);
}

TEST_F(LeavingTools, ASlideThatTurnsLosesNoWork) {
  // A block under a plate that goes to and fro, each way in less than four increments.
  const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [10, 5]], cells = [4, 2] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
[[support]]
where = "y = 5"
fix = ["x"]
move = { y = [[0, 0], [0.1, -0.01]] }
[[tool]]
name = "plate"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
motion = { displacement = [[0, 0, 0], [0.1, 0, 0], [0.19, 1, 0], [0.28, -1, 0], [0.37, 1, 0], [0.46, -1, 0], [0.55, 1, 0], [0.64, -1, 0], [0.73, 1, 0], [0.82, -1, 0], [0.91, 1, 0], [1, -1, 0]] }
friction = { law = "coulomb", mu = 0.2 }
[time]
end = 1
increments = { max = 0.03 }
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double force = std::abs(history().values("plate.force_y").back());
  const double expected = 0.2 * force * (1 + 9 * 2); // 0.2 to 0.4 of it before
  const nlohmann::json energy = summary()["energy"];
  EXPECT_NEAR(energy["friction_work"].get<double>(), expected, 0.02 * expected);
  EXPECT_NEAR(energy["external_work"].get<double>(), expected, 0.02 * expected);
}

TEST_F(LeavingTools, HandThePartToThoseThatComeAfterThem) {
  // 50 kN from a holder to a press that waits 3 mm above; the billet yields at 62.8 kN and may
  // never bear both.
  const Outcome outcome = run(R"(
analysis = "axisymmetric"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [10, 15]], cells = [4, 6] } }
[material.steel]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "linear", yield = 200, hardening = 500 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "anvil"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[[tool]]
name = "holder"
surface = { plane = { point = [0, 15], normal = [0, -1] } }
motion = { force = { direction = [0, -1], value = 50e3 } }
touch = true
[[tool]]
name = "press"
surface = { plane = { point = [0, 18], normal = [0, -1] } }
motion = { force = { direction = [0, -1], value = 50e3 } }
[[stage]]
name = "hold"
end = 1
tools = ["anvil", "holder"]
[[stage]]
name = "press"
end = 2
tools = ["anvil", "press"]
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  const std::size_t last = table.rows.size() - 1;
  EXPECT_NEAR(table.value(last, "press.force_y"), 50e3, 1.0);
  EXPECT_NEAR(table.value(last, "press.displacement_y"), -3.0, 0.05);
  EXPECT_EQ(table.value(last, "plastic_work"), 0.0);
  const double elastic = table.value(last, "elastic_energy");
  EXPECT_NEAR(table.value(last, "external_work"), elastic, 0.01 * elastic);
}

TEST_F(LeavingTools, DoNotPressOnWhileTheNextOneWorks) {
  // The same motions whenever the run ends: so are the forces.
  const auto force = [&](const std::string& end) {
    const Outcome outcome = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [10, 8]], cells = [8, 6] } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 100 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "flat"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
active = [0, 1]
motion = { displacement = [[0, 0, 0], [1, 0, -0.8]] }
[[tool]]
name = "round"
surface = { circle = { centre = [0, 11.2], radius = 4 } }
active = [1, 40]
motion = { displacement = [[0, 0, 0], [1, 0, 0], [2, 0, -0.3], [3, 0, -0.3]] }
[time]
increments = { max = 0.05 }
end = )" + end);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const ResultTable table = history();
    std::size_t row = 0;
    while (table.value(row, "time") < 2.0)
      ++row;
    EXPECT_NEAR(table.value(row, "time"), 2.0, 1e-9);
    return table.value(row, "round.force_y");
  };
  const double early = force("2"), late = force("20");
  EXPECT_GT(early, 100.0);
  EXPECT_NEAR(late, early, 5e-3 * early); // increments differ; forces that faded took 13 %
}

TEST_F(LeavingTools, LetMetalThatFlowsWithTimeAlone) {
  // Nothing presses while the billet lies on its die, however long.
  const Outcome outcome = run(R"(
analysis = "axisymmetric"
temperature = 1000
workpiece = { element = "quad8", material = "hot", mesh = { box = [[0, 0], [5, 10]], cells = [3, 5] } }
[material.hot]
elastic = { young = 100000, poisson = 0.3 }
flow = { law = "norton-hoff", K = 50, m = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[[tool]]
name = "punch"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = { velocity = [0, -2] }
[[measure]]
name = "height"
kind = "height"
[[stage]]
name = "press"
end = 1
[[stage]]
name = "wait"
end = 101
tools = ["die"]
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  EXPECT_NEAR(table.values("height").back(), 8.0, 0.01); // but for what springs back
  EXPECT_LT(table.rows.size(), 400U);
}

TEST_F(LeavingTools, DoNotAddTheirForceToOneThatRises) {
  // 15 kN after 18.4 kN, from nothing within a fortieth of the stage: the billet bears that.
  const Outcome outcome = run(R"(
analysis = "axisymmetric"
workpiece = { element = "quad8", material = "m", mesh = { box = [[0, 0], [5, 10]], cells = [3, 5] } }
[material.m]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "perfect", yield = 200 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[[tool]]
name = "punch"
surface = { plane = { point = [0, 10], normal = [0, -1] } }
motion = { displacement = [[0, 0, 0], [0.1, 0, -1.5], [1, 0, -1.5]] }
[[tool]]
name = "tup"
surface = { plane = { point = [0, 30], normal = [0, -1] } }
motion = { force = { direction = [0, -1], value = [[0.1, 0], [0.12, 15000], [1, 15000]] } }
[[measure]]
name = "height"
kind = "height"
[[stage]]
name = "press"
end = 0.1
tools = ["die", "punch"]
[[stage]]
name = "hold"
end = 1
tools = ["die", "tup"]
)");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(history().values("height").back(), 8.5, 0.01);
}

TEST_F(LeavingTools, ThatComeBackInsideThePartAreNamed) {
  const auto late = [&](double deep) {
    return run(R"(
analysis = "axisymmetric"
workpiece = { element = "quad4", material = "steel", mesh = { box = [[0, 0], [10, 5]], cells = [6, 3] } }
[material.steel]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, )" +
               std::to_string(5.1 - deep) + R"(], normal = [0, -1] } }
motion = { velocity = [0, -1] }
active = [0.1, 9]
[time]
end = 0.2
)");
  };
  const Outcome shallow = late(0.1);
  ASSERT_EQ(shallow.status, 8) << shallow.err; // half of the energy is missing
  EXPECT_TRUE(shallow.says("tool die began to act at t = 0.1 s inside the workpiece, 0.1"))
      << shallow.err;
  EXPECT_EQ(late(1.5).status, 5);
  const std::string post = whole_file(folder_.path() / "out/failure/post_mortem.txt");
  EXPECT_NE(post.find("tool 'die' begins to act inside the workpiece, 1.5"), std::string::npos)
      << post;
  EXPECT_FALSE(late(-0.01).says("inside the workpiece"));
}

} // namespace
} // namespace billet::test::leaving_tools_test
