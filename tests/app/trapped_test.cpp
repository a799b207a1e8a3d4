// Gas and lubricant in a blind groove that metal closes off, as a user meets them.

#include "tests/app/case_run.h"
#include "tests/support/case_texts.h"

#include <cmath>
#include <string>
#include <vector>

namespace billet::test::trapped_test {
namespace {

/// Half of a block under a die with a groove of 2 × 1 mm over the plane of symmetry.
const std::string grooved = R"(title    = "A groove"
analysis = "plane-strain"

[workpiece]
element  = "quad4"
material = "steel"
mesh     = { box = [[0, 0], [6, 4]], cells = [24, 16] }

[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "linear", yield = 300, hardening = 500 }

[[support]]
where = "x = 0"
fix   = ["x"]

[[support]]
where = "y = 0"
fix   = ["y"]

[[tool]]
name     = "die"
surface  = { profile = "die.toml" }
motion   = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.1 }

[contact]
trapped = { gas = { pressure = 0.1 } }

[time]
end = 0.4
)";

const std::string die = R"(# the die is on the left
start = [-3, 5]

[[segment]]
to = [2, 5]

[[segment]]
to = [2, 4.5]

[[segment]]
to = [2.5, 4]
radius = 0.5

[[segment]]
to = [12, 4]
)";

class Trapped : public CaseRun {
protected:
  Trapped() { write_text(folder_.path() / "die.toml", die); }
  [[nodiscard]] Outcome
  go(const std::string& text, const std::string& to, const std::vector<std::string>& more) const {
    write_text(folder_.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml", "--quiet", "--threads", "1", "-o", to};
    words.insert(words.end(), more.begin(), more.end());
    return billet(words, folder_.path());
  }
  [[nodiscard]] nlohmann::json summary_in(const std::string& folder) const {
    return nlohmann::json::parse(whole_file(folder_.path() / folder / "summary.json"));
  }
};

TEST_F(Trapped, GasIsCompressedAsMetalGoesIntoTheGroove) {
  const Outcome outcome = run(grooved);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultTable table = history();
  EXPECT_EQ(table.values("trapped.pockets").back(), 1.0);
  const double volume = table.values("trapped.volume").back(),
               pressure = table.values("trapped.pressure").back();
  const nlohmann::json trapped = summary()["trapped"];
  ASSERT_EQ(trapped["pockets"].size(), 1U);
  const nlohmann::json& pocket = trapped["pockets"][0];
  EXPECT_EQ(pocket["tool"], "die");
  EXPECT_EQ(trapped["closed"], 1);
  // 2 × 1 and the rounding, as the die comes down; the corner of the block is still free then.
  EXPECT_NEAR(pocket["volume_at_rest"].get<double>(), 2.0, 0.1);
  EXPECT_LT(volume, 0.9 * pocket["volume_at_rest"].get<double>());
  EXPECT_NEAR(pressure, 0.1 * (pocket["volume_at_rest"].get<double>() / volume - 1.0),
              0.01 * pressure); // but for dead volumes
  EXPECT_TRUE(outcome.says("a pocket is closed off at the end")) << outcome.err;
}

TEST_F(Trapped, LubricantKeepsItsVolumeAndLiftsTheDie) {
  const std::string oil =
      edited(grooved, {{"gas = { pressure = 0.1 }", "lubricant = { bulk_modulus = \"1.5 GPa\" }"}});
  ASSERT_EQ(go(grooved, "gas", {}).status, 0);
  ASSERT_EQ(go(oil, "oil", {}).status, 0);
  const nlohmann::json pocket = summary_in("oil")["trapped"]["pockets"][0];
  const double pressure = pocket["pressure"];
  EXPECT_GT(pressure, 50.0);
  EXPECT_NEAR(pocket["volume"].get<double>() / pocket["volume_at_rest"].get<double>(),
              std::exp(-pressure / 1500.0), 0.01);
  EXPECT_GT(summary_in("oil")["tools"]["die"]["force"][1].get<double>(),
            summary_in("gas")["tools"]["die"]["force"][1].get<double>());
  for (const char* const folder : {"gas", "oil"})
    EXPECT_LT(summary_in(folder)["energy"]["relative_error"].get<double>(), 0.005) << folder;
}

TEST_F(Trapped, GoesOnFromACheckpointWithTheSameBits) {
  const std::string often = grooved + "\n[output]\ncheckpoint_every = 0.05\n";
  ASSERT_EQ(go(often, "whole", {}).status, 0);
  const Outcome outcome = go(often, "branch", {"--from", "whole@0.38"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary_in("whole")["trapped"], summary_in("branch")["trapped"]);
}

TEST_F(Trapped, IsRefusedWhereItMakesNoSense) {
  const auto refused = [&](const std::string& instead, const std::string& words) {
    const Outcome outcome = run(edited(grooved, {{"{ gas = { pressure = 0.1 } }", instead}}));
    EXPECT_EQ(outcome.status, 3) << instead;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  refused("{ gas = { } }", "pressure");
  refused("{ gas = { pressure = -0.1 } }", "> 0");
  refused("{ gas = { pressure = 0.1, exponent = 3 } }", "exponent");
  refused("{ gaz = { pressure = 0.1 } }", "gas");
  refused("{ gas = { pressure = 0.1 }, lubricant = { bulk_modulus = 1500 } }", "one of them");
  refused("true", "table");
}

TEST_F(Trapped, IsForScenesInThePlane) {
  const Outcome outcome =
      run(upsetting_3d + "\n[contact]\ntrapped = { gas = { pressure = 0.1 } }\n");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("only for scenes in the plane"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace billet::test::trapped_test
