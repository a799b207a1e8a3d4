// Runs that end before their time: no way out for the metal, tools that meet, tools that no tool
// could stand for.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace billet::test {
namespace {

/// A unit square between a floor and a die that would go through it.
const std::string squeezed = R"(
analysis = "plane-strain"
[workpiece]
element = "quad4"
material = "m"
mesh = { box = [[0, 0], [1, 1]], cells = [2, 2] }
[material.m]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "perfect", yield = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[tool]]
name = "floor"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
[[tool]]
name = "die"
surface = { plane = { point = [0, 1], normal = [0, -1] } }
motion = { velocity = [0, -1.1] }
[time]
end = 1
)";

/// The same in a box; it gives way by its elasticity alone.
const std::string confined =
    edited(squeezed,
           {{"[[tool]]\nname = \"floor\"",
             "[[support]]\nwhere = \"x = 1\"\nfix = [\"x\"]\n[[tool]]\nname = \"floor\""},
            {"velocity = [0, -1.1]", "velocity = [0, -0.1]"}});

class EarlyEnd : public testing::Test {
protected:
  [[nodiscard]] nlohmann::json run(const std::string& text,
                                   const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml", "--quiet", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = billet(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(whole_file(folder_.path() / "out/summary.json"));
  }
  static bool says(const nlohmann::json& summary, const std::string& words) {
    for (const nlohmann::json& warning : summary.at("warnings"))
      if (warning.get<std::string>().find(words) != std::string::npos)
        return true;
    return false;
  }

private:
  TemporaryFolder folder_;
};

TEST_F(EarlyEnd, WhereToolsMeetButForAFilm) {
  const nlohmann::json summary = run(squeezed);
  EXPECT_EQ(summary.at("ended_by"), "tools together");
  EXPECT_TRUE(says(summary, "tools 'die' and 'floor' lie on each other"));
  // The film is thinner than a 500th of the part, and was thicker an increment before.
  const double left = 1.0 - 1.1 * summary.at("time").get<double>();
  EXPECT_LT(left, 0.002);
  EXPECT_GT(left, 0.001);
  // Without friction the force is that of a uniform block: 2 k over its width.
  const double width = summary.at("volume").get<double>() / left;
  const double force = summary.at("tools").at("floor").at("force").at(1).get<double>();
  // (The penalty lets each side in by a quarter of a per cent of the film.)
  EXPECT_NEAR(-force, 2.0 / std::sqrt(3.0) * 300.0 * width, 0.015 * -force);
}

TEST_F(EarlyEnd, WhereMetalHasNoWayOut) {
  const nlohmann::json summary = run(confined);
  EXPECT_EQ(summary.at("ended_by"), "full cavity");
  EXPECT_TRUE(says(summary, "the cavity is full"));
  EXPECT_TRUE(says(summary, "stop.on_full_cavity = false goes on"));
  // K = 166.7 GPa: 1 % of the volume takes 1.7 GPa, 5.6 times the yield stress, 1.8 % ten times.
  EXPECT_NEAR(summary.at("time"), 0.19, 0.02);
}

TEST_F(EarlyEnd, IsTheChoiceOfTheCase) {
  const nlohmann::json summary = run(confined + "[stop]\non_full_cavity = false\n"
                                                "on_tools_overloaded = false\n");
  EXPECT_EQ(summary.at("ended_by"), "end of time");
  EXPECT_EQ(summary.at("time"), 1.0);
  EXPECT_TRUE(says(summary, "the cavity is full"));
}

TEST_F(EarlyEnd, WhereNoToolBearsIt) {
  // As strong as its dies: squeezed by 5 % before a fifth flow stress.
  const std::string strong = edited(confined, {{"yield = 300", "yield = 2500"}});
  const nlohmann::json summary = run(strong);
  EXPECT_EQ(summary.at("ended_by"), "tools overloaded");
  EXPECT_LT(summary.at("volume"), 0.95);
  EXPECT_GT(summary.at("volume"), 0.94);
  const nlohmann::json in_pascals =
      run("units = \"m-N-s-Pa-degC\"\n" +
          edited(strong, {{"young = 200000", "young = 2e11"}, {"yield = 2500", "yield = 2.5e9"}}));
  EXPECT_EQ(in_pascals.at("ended_by"), "tools overloaded");
  EXPECT_EQ(in_pascals.at("time"), summary.at("time"));
}

TEST_F(EarlyEnd, GoesOnAfterAResumeThatAsksForIt) {
  EXPECT_EQ(run(confined).at("ended_by"), "full cavity");
  const nlohmann::json same = run(confined, {"--resume"});
  EXPECT_EQ(same.at("ended_by"), "full cavity");
  const nlohmann::json on = run(confined, {"--resume", "--set", "stop.on_full_cavity=false",
                                           "--set", "stop.on_tools_overloaded=false"});
  EXPECT_EQ(on.at("ended_by"), "end of time");
  EXPECT_EQ(on.at("time"), 1.0);
}

} // namespace
} // namespace billet::test
