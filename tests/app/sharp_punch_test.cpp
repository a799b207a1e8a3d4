// Punches with sharp edges: what faces do between their contact points.

#include "tests/app/tables.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace billet::test::sharp_punch_test {

namespace {

/// Half of a flat punch with a sharp edge, 3 wide, goes 0.6 deep into half of a block, 12 x 4.
std::string punch(const std::string& element, const std::string& cells) {
  return R"(
analysis = "plane-strain"
[workpiece]
element = ")" +
         element + R"("
material = "m"
mesh = { box = [[0, -4], [6, 0]], cells = )" +
         cells + R"( }
[material.m]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = -4"
fix = ["y"]
[[tool]]
name = "punch"
surface = { points = [[-3, 0], [1.5, 0], [1.5, 4]] }
motion = { velocity = [0, -0.6] }
[time]
end = 1
)";
}

class SharpPunch : public testing::Test {
protected:
  void run(const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    const Outcome outcome = billet({"run", "case.toml", "--quiet", "-o", "out"}, folder_.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] ResultTable history() const {
    return read_table(folder_.path() / "out" / "history.csv");
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(whole_file(folder_.path() / "out/summary.json"));
  }

  TemporaryFolder folder_;
};

// Before corners pressed, the force fell by 20 % each time the last point of a side had slid past
// the edge, and the side lay a fifth of an element inside the punch. (C.46)
TEST_F(SharpPunch, LosesNoForceWhenPointsSlidePastItsEdge) {
  for (const auto& [element, cells] :
       {std::pair{"quad4", "[48, 32]"}, std::pair{"quad8", "[24, 16]"}}) {
    run(punch(element, cells));
    const ResultTable table = history();
    const std::vector<double> force = table.values("punch.force_y");
    double fall = 0.0;
    for (std::size_t i = 1; i < force.size(); ++i)
      fall = std::max(fall, 1.0 - force[i] / force[i - 1]);
    const nlohmann::json results = summary();
    const double missed = results["energy"]["relative_error"];
    std::printf(
        "  %s: force falls by at most %.1f %% in an increment, %zu increments, energy %.1e\n",
        element, 100.0 * fall, force.size(), missed);
    EXPECT_LT(fall, 0.015) << element;
    EXPECT_LE(force.size(), 60u) << element;
    EXPECT_LT(std::abs(missed), 1e-3) << element;
    EXPECT_LT(table.values("max_penetration").back(), 0.003) << element;
  }
}

// (W.3): the volume is K / (H mu) times the work of friction, with what its corner rubs off.
TEST_F(SharpPunch, WearsByTheWorkOfItsFriction) {
  constexpr double K = 1e-3, H = 1000.0, mu = 0.2;
  std::string text = punch("quad8", "[24, 16]");
  text.insert(text.find("motion = "), "friction = { law = \"coulomb\", mu = 0.2 }\nwear = { law = "
                                      "\"archard\", K = 1e-3, hardness = 1000 }\n");
  run(text);
  const nlohmann::json results = summary();
  const double expected = K / (H * mu) * results["energy"]["friction_work"].get<double>();
  EXPECT_NEAR(results["tools"]["punch"]["wear"]["volume"].get<double>(), expected, 5e-3 * expected);
}

// Its corner draws back with it: it used to hold the part down.
TEST_F(SharpPunch, LeavesThePartFreeWhenItIsUnloaded) {
  std::string text = punch("quad4", "[24, 16]");
  const std::string end = "[time]\nend = 1\n";
  text.replace(text.find(end), end.size(),
               "[[stage]]\nname = \"press\"\nend = 1\n[[stage]]\nname = \"leave\"\nend = "
               "2\nunload = true\n");
  run(text);
  const ResultTable table = history();
  EXPECT_EQ(table.values("punch.force_y").back(), 0.0);
  EXPECT_EQ(table.values("punch.force_x").back(), 0.0);
  const std::vector<double> elastic = table.values("elastic_energy");
  EXPECT_LT(elastic.back(), 0.4 * *std::max_element(elastic.begin(), elastic.end()));
  EXPECT_LT(std::abs(summary()["energy"]["relative_error"].get<double>()), 2e-3);
}

} // namespace

} // namespace billet::test::sharp_punch_test
