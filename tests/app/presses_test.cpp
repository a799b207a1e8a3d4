// Presses from case file to results: energy and stroke of blows, a crank's dead centre.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::test::presses_test {

namespace {

/// The tiny upsetting with a press in place of the constant velocity.
std::string pressed(const std::string& press, const std::string& stages) {
  return edited(upsetting, {{"{ velocity = [0, -1] }", "{ press = { " + press + " } }"},
                            {"end = 0.1\nincrements = { first = 0.02, max = 0.02 }\n", ""},
                            {"[time]\n", stages}});
}

class Presses : public testing::Test {
protected:
  [[nodiscard]] std::filesystem::path run(const std::string& text,
                                          const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / "press.toml", text);
    std::vector<std::string> words{"run", "press.toml", "--quiet", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = billet(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_.path() / "out";
  }
  static nlohmann::json summary(const std::filesystem::path& results) {
    return nlohmann::json::parse(whole_file(results / "summary.json"));
  }

  TemporaryFolder folder_;
};

const std::string two_blows = R"(
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

/// A frictionless block, 5 x 4 x 6 mm, pressed by 0.6 mm and then struck with 8 J mm.
std::string pressed_and_struck(double stage) {
  return fmt::format(R"(
analysis = "3d"
[workpiece]
element = "hex8"
material = "m"
mesh = {{ box = [[0, 0, 0], [5, 4, 6]], cells = [2, 2, 2] }}
[material.m]
elastic = {{ young = 200000, poisson = 0.3 }}
flow = {{ law = "linear", yield = 300, hardening = 200 }}
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
surface = {{ plane = {{ point = [0, 0, 6], normal = [0, 0, -1] }} }}
motion = {{ press = {{ kind = "hammer", direction = [0, 0, -1], energy = 8000, mass = 0.001 }} }}
[[tool]]
name = "punch"
surface = {{ plane = {{ point = [0, 0, 6], normal = [0, 0, -1] }} }}
motion = {{ displacement = [[0, 0, 0, 0], [1, 0, 0, -0.6], [2, 0, 0, -0.6]] }}
[[measure]]
name = "height"
kind = "height"
direction = [0, 0, 1]
[[stage]]
name = "press"
end = 1
tools = ["punch"]
[[stage]]
name = "strike"
end = {}
tools = ["ram"]
)",
                     1.0 + stage);
}

TEST_F(Presses, ABlowIsNotHelpedByAToolThatHasLeft) {
  // Uniform strain: the work that the two tools may do is that of the flow curve.
  for (const double stage : {0.002, 0.1}) {
    const std::filesystem::path results = run(pressed_and_struck(stage));
    const nlohmann::json said = summary(results);
    EXPECT_NEAR(said.at("blows").at(0).at("energy_used").get<double>(), 8000.0, 1.0);
    const double height = read_table(results / "history.csv").values("height").back();
    EXPECT_NEAR(height, 4.439, 2e-3) << stage;
  }
}

TEST_F(Presses, AStageThatUnloadsEndsABlowThatIsNotOver) {
  const std::string hammer =
      R"(kind = "hammer", direction = [0, -1], energy = "40 J", velocity = "5 m/s")";
  const std::filesystem::path results =
      run(pressed(hammer, edited(two_blows, {{"end = 0.1\n", "end = 0.0002\n"}})));
  const nlohmann::json said = summary(results);
  const nlohmann::json& cut = said.at("blows").at(0);
  EXPECT_FALSE(cut.at("over").get<bool>());
  EXPECT_GT(cut.at("energy_left").get<double>(), 4e3);
  EXPECT_NEAR(cut.at("energy_used").get<double>() + cut.at("energy_left").get<double>(), 40e3, 1.0);
  EXPECT_NEAR(cut.at("time").get<double>(), 0.0002, 1e-9);
  EXPECT_NE(said.at("warnings").at(0).get<std::string>().find("[blow-cut]"), std::string::npos);
}

TEST_F(Presses, AHammerSaysWhatItsBlowsUsed) {
  const std::string hammer =
      R"(kind = "hammer", direction = [0, -1], energy = "0.05 kJ", velocity = "5 m/s", efficiency = 0.8)";
  const std::filesystem::path results = run(pressed(hammer, two_blows));
  const nlohmann::json said = summary(results);
  EXPECT_EQ(said.at("ended_by"), "energy used up");
  ASSERT_EQ(said.at("blows").size(), 2U);
  double stroke = 0.0;
  for (const nlohmann::json& blow : said.at("blows")) {
    EXPECT_EQ(blow.at("tool"), "punch");
    EXPECT_NEAR(blow.at("energy").get<double>(), 40e3, 1e-6);
    EXPECT_NEAR(blow.at("energy_used").get<double>() + blow.at("energy_left").get<double>(), 40e3,
                1e-5 * 40e3);
    EXPECT_LE(blow.at("energy_left").get<double>(), 1e-5 * 40e3);
    EXPECT_TRUE(blow.at("over").get<bool>());
    stroke += blow.at("stroke").get<double>();
  }
  EXPECT_EQ(said.at("blows")[1].at("begun"), 0.2);
  EXPECT_LT(said.at("time").get<double>(), 0.21);
  EXPECT_GT(stroke, 0.5);
  EXPECT_LE(said.at("energy").at("relative_error").get<double>(), 5e-3);
  EXPECT_NE(whole_file(results / "run.log").find("press 'punch': its blow is over after"),
            std::string::npos);
  // The resolved case strikes to the same bits.
  const std::string first = whole_file(results / "iterations.csv");
  const std::string again =
      whole_file(run(whole_file(results / "case.resolved.toml")) / "iterations.csv");
  EXPECT_EQ(first, again);
}

TEST_F(Presses, ACrankEndsAnIncrementAtItsDeadCentre) {
  const std::string crank =
      R"(kind = "crank", direction = [0, -1], radius = 20, rod = 100, speed = "60 rpm", start = 160)";
  const std::filesystem::path results = run(pressed(crank, "[time]\nend = 0.07\n"));
  const ResultTable history = read_table(results / "history.csv");
  const double start = 160.0 * std::numbers::pi / 180.0;
  const auto from_top = [](double angle) {
    return 20.0 * (1.0 - std::cos(angle)) - 100.0 +
           std::sqrt(1e4 - std::pow(20.0 * std::sin(angle), 2));
  };
  double deepest = 0.0;
  for (std::size_t row = 0; row < history.rows.size(); ++row) {
    const double time = history.value(row, "time");
    const double way = from_top(start + 2.0 * std::numbers::pi * time) - from_top(start);
    EXPECT_NEAR(-history.value(row, "punch.displacement_y"), way, 1e-12 * 100.0);
    deepest = std::max(deepest, -history.value(row, "punch.displacement_y"));
  }
  EXPECT_NEAR(deepest, 40.0 - from_top(start), 1e-12 * 100.0);
}

TEST_F(Presses, ACrankThatStartsAboveThePartDoesTheWorkOfOneThatTouches) {
  const std::string free_block = R"(analysis = "axisymmetric"
[workpiece]
element = "quad4"
material = "metal"
mesh = { box = [[0, 0], [10, 20]], cells = [3, 3] }
[material.metal]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "perfect", yield = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "punch"
surface = { plane = { point = [0, 25], normal = [0, -1] } }
motion = { press = { kind = "crank", direction = [0, -1], radius = 50, rod = 200, speed = "60 rpm", start = 150 } }
[time]
end = 0.2
)";
  const std::filesystem::path results = run(free_block);
  const ResultTable history = read_table(results / "history.csv");
  const double external = history.values("external_work").back();
  EXPECT_NEAR(external, history.values("plastic_work").back(), 2e-3 * external);
}

} // namespace

} // namespace billet::test::presses_test
