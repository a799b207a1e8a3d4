// Presses from case file to results: energy and stroke of blows, a crank's dead centre.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

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
