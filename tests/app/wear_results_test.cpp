// Wear in the results: summary, frames, the resolved case; the same in other units and with other
// numbers of threads.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/vtk_arrays.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>

namespace billet::test::wear_results_test {

namespace {

const std::string worn =
    edited(upsetting,
           {{"friction = { law = \"tresca\", m = 0.08 }",
             "friction = { law = \"coulomb\", mu = 0.1 }\nwear = { law = \"archard\", "
             "K = 1e-4, hardness = \"8 GPa\", K_workpiece = 1e-3, strokes = 10000 }"}});

class WearResults : public testing::Test {
protected:
  /// Runs a case and returns its results.
  [[nodiscard]] std::filesystem::path run(const std::string& name,
                                          const std::string& text,
                                          const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / (name + ".toml"), text);
    std::vector<std::string> words{"run", name + ".toml", "--quiet", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = billet(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_.path() / name;
  }
  [[nodiscard]] static nlohmann::json wear_of(const std::filesystem::path& results) {
    return nlohmann::json::parse(whole_file(results / "summary.json"))
        .at("tools")
        .at("punch")
        .at("wear");
  }

  TemporaryFolder folder_;
};

TEST_F(WearResults, are_in_the_summary) {
  const auto folder = run("tiny", worn);
  const nlohmann::json wear = wear_of(folder);
  const double friction = read_table(folder / "history.csv").values("friction_work").back();
  const double volume = wear.at("volume");
  EXPECT_NEAR(volume, 1e-4 / 8000.0 * friction / 0.1, 0.02 * volume);
  EXPECT_GT(wear.at("largest_depth"), 0.0);
  EXPECT_EQ(wear.at("strokes"), 10000.0);
  EXPECT_EQ(wear.at("volume_extrapolated"), 10000.0 * volume);
  EXPECT_EQ(wear.at("largest_depth_extrapolated"),
            10000.0 * wear.at("largest_depth").get<double>());
  // Where it is: on the punch, 0.1 below where it began; it slides most at the rim.
  EXPECT_NEAR(wear.at("at").at(1), 7.4, 1e-12);
  EXPECT_NEAR(wear.at("at_in_tool_frame").at(1), 7.5, 1e-12);
  EXPECT_GT(wear.at("at").at(0), 3.0);
  // The default hardness of the workpiece: 3 x 740 x 0.01^0.2.
  const double ratio = 1e-3 / (3.0 * 740.0 * std::pow(0.01, 0.2)) / (1e-4 / 8000.0);
  EXPECT_NEAR(wear.at("workpiece").at("volume"), ratio * volume, 1e-9 * ratio * volume);
  EXPECT_GT(wear.at("workpiece").at("largest_depth"), 0.0);
}

TEST_F(WearResults, are_in_the_frames_of_tool_and_workpiece) {
  const auto folder = run("tiny", worn, {"--set", "output.every=0.1"});
  const std::string tool = whole_file(folder / "frames/tool-punch_0001.vtp");
  EXPECT_NE(tool.find("Name=\"wear_depth\""), std::string::npos);
  EXPECT_NE(tool.find("Name=\"wear_depth_extrapolated\""), std::string::npos);
  EXPECT_NE(tool.find("unit of wear_depth: mm"), std::string::npos);
  EXPECT_NE(whole_file(folder / "frames/workpiece_0001.vtu").find("Name=\"wear_depth\""),
            std::string::npos);
  const auto chosen = run("chosen", worn, {"--set", "output.fields=[\"wear_depth\"]"});
  EXPECT_EQ(whole_file(chosen / "frames/tool-punch_0001.vtp").find("wear_depth_extrapolated"),
            std::string::npos);
  const auto without = run("without", upsetting);
  EXPECT_EQ(whole_file(without / "frames/tool-punch_0001.vtp").find("wear"), std::string::npos);
  EXPECT_EQ(whole_file(without / "frames/workpiece_0001.vtu").find("wear"), std::string::npos);
  EXPECT_EQ(whole_file(without / "summary.json").find("\"wear\""), std::string::npos);
}

/// A block beneath a plane that presses it and goes aside by twenty of its lengths.
const std::string slid = R"(analysis = "plane-strain"
workpiece = { element = "quad4", material = "steel", mesh = { box = [[0, 0], [5, 2]], cells = [5, 2] } }
material.steel = { elastic = { young = "210 GPa", poisson = 0.3 }, flow = { law = "perfect", yield = 300 } }
support = [{ where = "y = 0", fix = ["x", "y"] }]
time = { end = 2 }

[[tool]]
name     = "punch"
surface  = { plane = { point = [0, 2], normal = [0, -1] } }
motion   = { displacement = [[0, 0, 0], [1, 0, -0.001], [2, 100, -0.001]] }
friction = { law = "coulomb", mu = 0.1 }
wear     = { law = "archard", K = 1e-4, hardness = "8 GPa" }
)";

/// Depth times length, over the lines of a tool's frame in the plane.
double shown_volume(const std::string& frame) {
  const auto points = array_of<double>(frame, "Points", "<Points>");
  const auto depth = array_of<double>(frame, "wear_depth", "<CellData>");
  const auto nodes = array_of<std::int32_t>(frame, "connectivity", "<Lines>");
  EXPECT_EQ(nodes.size(), 2 * depth.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto x = [&](std::size_t end, std::size_t d) {
      return points.at(3 * static_cast<std::size_t>(nodes.at(2 * i + end)) + d);
    };
    sum += depth[i] * std::hypot(x(1, 0) - x(0, 0), x(1, 1) - x(0, 1));
  }
  return sum;
}

TEST_F(WearResults, are_whole_in_the_frame_of_a_plane_that_slid_far) {
  const auto folder = run("slid", slid, {"--set", "output.every=2"});
  const double volume = wear_of(folder).at("volume");
  EXPECT_GT(volume, 0.0);
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(shown_volume(whole_file(folder / "frames/tool-punch_0001.vtp")), volume,
              rounding * volume);
}

TEST_F(WearResults, repeat_from_the_resolved_case_and_with_other_threads) {
  const auto first = run("tiny", worn, {"--threads", "1"});
  const auto again = run("again", whole_file(first / "case.resolved.toml"), {"--threads", "2"});
  EXPECT_EQ(wear_of(first), wear_of(again));
  EXPECT_EQ(whole_file(first / "case.resolved.toml"), whole_file(again / "case.resolved.toml"));
}

TEST_F(WearResults, do_not_depend_on_the_units) {
  const auto mm = wear_of(run("mm", worn));
  const auto m =
      wear_of(run("m", edited(worn, {{"analysis", "units = \"m-N-s-Pa-degC\"\nanalysis"},
                                     {"[5, 7.5]", "[0.005, 0.0075]"},
                                     {"K = 740", "K = 740e6"},
                                     {"point = [0, 7.5]", "point = [0, 0.0075]"},
                                     {"velocity = [0, -1]", "velocity = [0, -0.001]"}})));
  constexpr double rounding = 1e-9;
  const double volume = mm.at("volume"), depth = mm.at("largest_depth");
  EXPECT_NEAR(1e9 * m.at("volume").get<double>(), volume, rounding * volume);
  EXPECT_NEAR(1e3 * m.at("largest_depth").get<double>(), depth, rounding * depth);
}

TEST_F(WearResults, of_an_elastic_workpiece_ask_for_its_hardness) {
  const std::string elastic =
      edited(worn, {{"flow    = { law = \"swift\", K = 740, eps0 = 0.01, n = 0.2 }\n", ""}});
  write_text(folder_.path() / "elastic.toml", elastic);
  const Outcome outcome = billet({"check", "elastic.toml"}, folder_.path());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("nothing gives the hardness of the workpiece"), std::string::npos)
      << outcome.err;
}

} // namespace

} // namespace billet::test::wear_results_test
