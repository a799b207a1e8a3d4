// Remeshing from case file to results: the ledger, frames before and after, warnings.

#include "geometry/base/vector.h"
#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace billet::test::remeshing_test {

namespace {

/// The tiny upsetting with a section about remeshing.
std::string remeshed(const std::string& keys) {
  return edited(upsetting, {{"[time]", "[remesh]\n" + keys + "\n\n[time]"}});
}

const std::string often = "when = { interval = 0.02 }"; // each increment but the last

/// A sticking billet that is pressed until its four-node elements are no good.
const std::string pressed_far =
    edited(upsetting,
           {{"\"quad8\"", "\"quad4\""},
            {"law = \"tresca\", m = 0.08", "law = \"sticking\""},
            {"end = 0.1\nincrements = { first = 0.02, max = 0.02 }", "end = 4.5"},
            {"cells = [2, 3]", "cells = [4, 6]"}});

class Remeshing : public testing::Test {
protected:
  [[nodiscard]] std::filesystem::path run(const std::string& text,
                                          const std::string& out = "out") const {
    write_text(folder_.path() / "tiny.toml", text);
    const Outcome outcome = billet({"run", "tiny.toml", "--quiet", "-o", out}, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_.path() / out;
  }
  [[nodiscard]] Outcome check(const std::string& text) const {
    write_text(folder_.path() / "tiny.toml", text);
    return billet({"check", "tiny.toml"}, folder_.path());
  }
  static nlohmann::json summary(const std::filesystem::path& results) {
    return nlohmann::json::parse(whole_file(results / "summary.json"));
  }
  /// Pieces of warnings in the summary.
  static bool warns(const std::filesystem::path& results, const std::string& piece) {
    const nlohmann::json warnings = summary(results).value("warnings", nlohmann::json::array());
    return std::any_of(warnings.begin(), warnings.end(), [&](const nlohmann::json& warning) {
      return warning.get<std::string>().find(piece) != std::string::npos;
    });
  }

  TemporaryFolder folder_;
};

const std::string header =
    "remeshing,increment,time,cause,elements_before,elements_after,nodes_before,nodes_after,"
    "quality_before,quality_after,volume_before,volume_after,plastic_work_before,"
    "plastic_work_after,mean_plastic_strain_before,mean_plastic_strain_after,"
    "max_plastic_strain_before,max_plastic_strain_after,energy,residual,balanced,solved_again,"
    "force_jump,"
    "returned,"
    "seconds,punch.force_before,punch.force_after\n";

TEST_F(Remeshing, KeepsTheWorkOfSupportsFromBeforeTheMetalFlowed) {
  // A bar that is pulled, uniform in each increment; the way that is solved again begins before
  // yield.
  const std::filesystem::path results = run(R"(
analysis = "3d"
[workpiece]
element = "tet10"
material = "m"
mesh = { box = [[0, 0, 0], [2, 3, 10]], cells = [2, 2, 6] }
[material.m]
elastic = { young = 100000, poisson = 0.3 }
flow = { law = "linear", yield = 40, hardening = 2000 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "z = 0"
fix = ["z"]
[[support]]
where = "z = 10"
move = { z = [[0, 0], [1, 3]] }
[time]
end = 0.1
increments = { max = 0.02 }
[remesh]
when = { interval = 0.04 }
size = { default = 1.6 }
)");
  const ResultTable history = read_table(results / "history.csv");
  const std::size_t last = history.rows.size() - 1;
  const double stored = history.value(last, "plastic_work") + history.value(last, "elastic_energy");
  EXPECT_NEAR(history.value(last, "external_work"), stored, 1e-3 * stored);
}

TEST_F(Remeshing, CountsTheWorkOfAPressureOnce) {
  // The way to a new mesh is gone again from several states until the die's force is right; what a
  // pressure did on the ways that are not taken is not its work.
  const auto out = run(R"(analysis = "plane-strain"
workpiece = { element = "quad8", material = "sheet", mesh = { box = [[0, 0], [20, 1]], cells = [20, 1] } }
[material.sheet]
elastic = { young = 70000, poisson = 0.3 }
flow = { law = "swift", K = 300, eps0 = 0.01, n = 0.25 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "x = 20"
fix = ["x", "y"]
[[load]]
where = "y = 0"
pressure = [[0, 0], [1, 12]]
[[tool]]
name = "die"
surface = { plane = { point = [0, 4], normal = [0, -1] } }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
[remesh]
)");
  const nlohmann::json energy = summary(out)["energy"];
  const double done = energy["elastic_energy"].get<double>() +
                      energy["plastic_work"].get<double>() + energy["friction_work"].get<double>();
  EXPECT_GE(read_table(out / "remesh.csv").rows.size(), 1U);
  EXPECT_NEAR(energy["external_work"].get<double>(), done, 0.01 * done);
  EXPECT_LT(std::abs(energy["lost_in_remeshing"].get<double>()), 0.01 * done);
}

TEST_F(Remeshing, RefinesBeforeATouchingToolComesDownElsewhere) {
  // A tool with a flat foot and, half a millimetre higher, a round one.
  write_text(folder_.path() / "feet.toml", R"(start = [2.2, 8]
[[segment]]
to = [2.2, 5.1]
[[segment]]
to = [3.1, 5.1]
[[segment]]
to = [3.1, 8]
[[segment]]
to = [4.5, 8]
[[segment]]
to = [4.5, 6.2]
[[segment]]
to = [9.5, 6.2]
radius = 4
[[segment]]
to = [9.5, 8]
)");
  const auto results = run(R"(analysis = "plane-strain"

[workpiece]
material = "steel"
mesh = { box = [[0, 0], [10, 5]], cells = [10, 5] }

[material.steel]
elastic = { young = 210000, poisson = 0.3 }
flow = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }

[[support]]
where = "y = 0"
fix = ["x", "y"]

[[tool]]
name = "feet"
surface = { profile = "feet.toml" }
motion = { velocity = [0, -1] }

[remesh]

[time]
end = 0.4
)");
  const std::string ledger = whole_file(results / "remesh.csv");
  const auto first = ledger.find("feet comes to touch on");
  ASSERT_NE(first, std::string::npos) << ledger;
  EXPECT_NE(ledger.find("feet comes to touch on", first + 1), std::string::npos) << ledger;
  EXPECT_EQ(ledger.find("feet touches on"), std::string::npos) << ledger;
}

// Nodes of a new mesh went onto the tool, not as deep into it as the pressure needs; what the mesh
// was off by faded with the slide, and the force with it: 99 % of it in 48 meshes at this penalty.
TEST_F(Remeshing, UnderASlidingToolKeepsTheForce) {
  const auto results = run(R"(
analysis = "plane-strain"
workpiece = { element = "quad8", material = "m", mesh = { box = [[0, 0], [10, 5]], cells = [10, 5] } }
[material.m]
elastic = { young = 100000, poisson = 0.33 }
[[support]]
where = "y = 5"
move = { y = [[0, 0], [0.1, -0.01], [2, -0.01]] }
fix = ["x"]
[[tool]]
name = "belt"
surface = { plane = { point = [0, 0], normal = [0, 1] } }
motion = { displacement = [[0, 0, 0], [0.1, 0, 0], [1.1, 1, 0]] }
[contact]
penalty = 1
[remesh]
when = { interval = 0.02 }
[time]
end = 0.6
)");
  const ResultTable table = read_table(results / "history.csv");
  const std::vector<double> force = table.values("belt.force_y");
  const double pressed = std::abs(*std::min_element(force.begin(), force.end()));
  EXPECT_GE(table.values("remeshings").back(), 20.0);
  EXPECT_NEAR(std::abs(force.back()), pressed, 0.003 * pressed);
}

TEST_F(Remeshing, ANotchThatClosesIsWeldedOrTold) {
  write_text(folder_.path() / "notched.toml",
             "closed = true\npoints = [[0, 0], [10, 0], [10, 10], [5.1, 10], [5.1, 6], [4.9, 6], "
             "[4.9, 10], [0, 10]]\n");
  const std::string pressed = R"(
analysis = "plane-strain"
workpiece = { element = "tri6", material = "steel", mesh = { outline = "notched.toml", size = 1 } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "x = 10"
move = { x = [[0, 0], [1, -1]] }
[time]
end = 1
)";
  const std::string unfelt = "[contact]\nself = false\n";
  EXPECT_TRUE(warns(run(pressed + unfelt, "kept"), "the boundary of the part crosses itself near"));
  const std::string remesh = "[remesh]\nwhen = { interval = 0.25 }\n";
  EXPECT_FALSE(warns(run(pressed + remesh, "two"), "welded a fold, 4")) << "not unasked";
  const auto kept = run(pressed + remesh + "weld = true\n", "kept-anew");
  EXPECT_TRUE(warns(kept, "walls of the part have met")) << "there is a mesh without a weld";
  EXPECT_FALSE(warns(kept, "crosses itself"));
  const auto anew = run(pressed + remesh + "weld = true\n" + unfelt, "welded-anew");
  EXPECT_TRUE(warns(anew, "welded a fold, 4.1")) << "4 deep";
  EXPECT_FALSE(warns(anew, "crosses itself"));
}

using RemeshingLong = Remeshing;

/// A pipe crushed flat, meshed anew all the time: the walls that meet stay two, and are one lap.
TEST_F(RemeshingLong, WallsThatMeetStayApart) {
  const std::filesystem::path pipe =
      std::filesystem::path(BILLET_SOURCE_DIR) / "cases" / "pipe-flat";
  write_text(folder_.path() / "pipe.inp", whole_file(pipe / "pipe.inp"));
  const std::filesystem::path results = run(edited(
      whole_file(pipe / "case.toml"), {{"[time]", "[remesh]\nwhen = { interval = 1 }\n[time]"}}));
  const nlohmann::json laps = summary(results).at("laps");
  EXPECT_EQ(laps.at(0).at("state"), "closed");
  // Of the half pipe's inner wall, 76 mm long when it is flat, and of its root, 4 mm without new
  // meshes, what these leave.
  EXPECT_GT(laps.at(0).at("depth"), 76.0);
  EXPECT_LT(laps.at(0).at("depth"), 81.0);
  EXPECT_NEAR(laps.at(0).at("since"), 93.3, 0.2);
  for (const nlohmann::json& lap : laps)
    if (lap.at("state") == "welded") {
      EXPECT_LT(lap.at("depth"), 0.5);
    }
}

TEST_F(RemeshingLong, ANotchInSpaceThatClosesIsDrawnFlatOrTold) {
  // A block of 6 x 6 x 3 with a notch of 0.6 x 1 across its top.
  const std::vector<Vec2> outline{{0, 0}, {6, 0}, {6, 6}, {3.3, 6}, {3, 5}, {2.7, 6}, {0, 6}};
  constexpr std::size_t tip = 4;
  constexpr double depth = 3.0;
  std::string stl = "solid notched\n";
  const auto facet = [&](std::initializer_list<Vec3> corners) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& x : corners)
      stl += fmt::format("vertex {} {} {}\n", x.x(), x.y(), x.z());
    stl += "endloop\nendfacet\n";
  };
  const auto at = [&](std::size_t i, double z) {
    const Vec2& x = outline[i % outline.size()];
    return Vec3(x.x(), x.y(), z);
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    facet({at(i, 0), at(i + 1, 0), at(i + 1, depth)});
    facet({at(i, 0), at(i + 1, depth), at(i, depth)});
    if (i == tip || i + 1 == tip)
      continue;
    facet({at(tip, depth), at(i, depth), at(i + 1, depth)});
    facet({at(tip, 0), at(i + 1, 0), at(i, 0)});
  }
  write_text(folder_.path() / "notched.stl", stl + "endsolid notched\n");
  const auto pressed = [](const std::string& end) {
    return R"(
analysis = "3d"
workpiece = { element = "tet10", material = "steel", mesh = { stl = "notched.stl", size = 1.2 } }
[material.steel]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "z = 0"
fix = ["z"]
[[support]]
where = "x = 6"
move = { x = [[0, 0], [1, -1.5]] }
[time]
end = )" + end;
  };
  EXPECT_TRUE(warns(run(pressed("0.3\n[contact]\nself = false\n"), "kept"),
                    "the boundary of the part crosses itself near"));
  const auto anew = run(
      pressed("0.45\n[remesh]\nwhen = { interval = 0.25 }\nsize = { default = 1.2 }\n"), "anew");
  EXPECT_TRUE(warns(anew, "remeshing 1 welded a fold"));
  EXPECT_FALSE(warns(anew, "crosses itself"));
  const ResultTable table = read_table(anew / "history.csv");
  const double volume = table.value(table.rows.size() - 1, "volume");
  EXPECT_NEAR(volume, table.value(0, "volume"), 2e-3 * volume);
}

TEST_F(Remeshing, WritesItsLedger) {
  const std::string in_small_steps =
      edited(remeshed(often), {{"first = 0.02, max = 0.02", "first = 0.002, max = 0.002"}});
  constexpr std::size_t steps = 10; // between two meshes
  const auto results = run(in_small_steps);
  EXPECT_TRUE(whole_file(results / "remesh.csv").starts_with(header));
  const ResultTable ledger = read_table(results / "remesh.csv");
  const ResultTable history = read_table(results / "history.csv");
  const nlohmann::json found = summary(results).at("remeshings");
  ASSERT_EQ(ledger.rows.size(), 4u);
  EXPECT_EQ(found.at("number"), 4);
  EXPECT_EQ(found.at("without_equilibrium"), 0);
  double volume = 0.0, work = 0.0, jump = 0.0;
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(ledger.value(row, "remeshing"), static_cast<double>(row + 1));
    const std::size_t increment = steps * (row + 1);
    EXPECT_EQ(ledger.value(row, "increment"), static_cast<double>(increment));
    EXPECT_EQ(ledger.value(row, "time"), history.value(increment - 1, "time"));
    EXPECT_EQ(ledger.rows[row][ledger.index("cause")], "\"interval\"");
    EXPECT_EQ(ledger.rows[row][ledger.index("balanced")], "1");
    const auto change = [&](const std::string& what) {
      const double before = ledger.value(row, what + "_before");
      return std::abs(ledger.value(row, what + "_after") - before) / before;
    };
    volume = std::max(volume, change("volume"));
    work = std::max(work, change("plastic_work"));
    jump = std::max(jump, ledger.value(row, "force_jump"));
    EXPECT_NEAR(ledger.value(row, "force_jump"), change("punch.force"), 1e-12);
  }
  EXPECT_EQ(ledger.value(0, "elements_before"), 6.0);
  EXPECT_EQ(found.at("largest_change_of_volume"), volume);
  EXPECT_EQ(found.at("largest_change_of_plastic_work"), work);
  EXPECT_EQ(found.at("largest_force_jump"), jump);
  EXPECT_LT(volume, 1e-4);
  // The column says how many there had been when the increment was accepted.
  for (std::size_t row = 0; row < history.rows.size(); ++row)
    EXPECT_EQ(history.value(row, "remeshings"),
              static_cast<double>(std::min<std::size_t>(row / steps, 4)));
  EXPECT_EQ(summary(results).at("element"), "tri6");
  EXPECT_EQ(summary(results).at("elements"), ledger.value(3, "elements_after"));
  EXPECT_GT(summary(results).at("seconds").at("remeshing"), 0.0);
  const std::string log = whole_file(results / "run.log");
  EXPECT_NE(log.find("remeshing 4 (interval): "), std::string::npos) << log;
}

TEST_F(Remeshing, WritesFramesBeforeAndAfter) {
  const auto results = run(remeshed(often) + "\n[output]\nevery = 0.05\n");
  expect_whole_results(results, "tiny");
  const std::vector<double> times = frame_times(results / "tiny.pvd");
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  const ResultTable ledger = read_table(results / "remesh.csv");
  ASSERT_FALSE(ledger.rows.empty());
  for (const double time : ledger.values("time"))
    EXPECT_EQ(std::count(times.begin(), times.end(), time), 2) << time;
  // The files of the two are of different meshes.
  std::vector<std::string> at_first;
  for (const ListedFile& entry : read_list(results / "tiny.pvd"))
    if (entry.part == "workpiece" && entry.time == ledger.value(0, "time"))
      at_first.push_back(whole_file(results / entry.file));
  ASSERT_EQ(at_first.size(), 2u);
  const auto cells = [](const std::string& text) {
    const std::string key = "NumberOfCells=\"";
    return std::strtod(text.c_str() + text.find(key) + key.size(), nullptr);
  };
  EXPECT_EQ(cells(at_first[0]), ledger.value(0, "elements_before"));
  EXPECT_EQ(cells(at_first[1]), ledger.value(0, "elements_after"));
}

TEST_F(Remeshing, ThatIsNotNeededLeavesALedgerWithoutRows) {
  const auto results = run(remeshed(""));
  EXPECT_EQ(whole_file(results / "remesh.csv"), header);
  EXPECT_EQ(summary(results).at("remeshings").at("number"), 0);
  const ResultTable with = read_table(results / "history.csv");
  const std::string plain = upsetting + "\n[contact]\nform = \"compatible\"\n"; // as with [remesh]
  const ResultTable without = read_table(run(plain, "plain") / "history.csv");
  EXPECT_EQ(with.without_wall_time(), without.without_wall_time());
}

TEST_F(Remeshing, ThatCannotBeDoneIsTold) {
  const auto results = run(remeshed(often + "\nsize = { default = 1e-4 }"));
  EXPECT_EQ(summary(results).at("remeshings").at("number"), 0);
  EXPECT_GT(summary(results).at("remeshings").at("refused"), 0);
  EXPECT_TRUE(warns(results, "a new mesh was wanted and could not be made"));
  EXPECT_FALSE(warns(run(remeshed(often), "fine"), "could not be made"));
}

TEST_F(Remeshing, NotAskedForLeavesNoLedger) {
  (void)run(remeshed(often));
  const auto results = run(upsetting);
  EXPECT_FALSE(std::filesystem::exists(results / "remesh.csv")) << "that of an earlier run goes";
  EXPECT_FALSE(summary(results).contains("remeshings"));
}

TEST_F(Remeshing, ResolvedRunsAgainToTheSameNumbers) {
  const auto first = run(remeshed(often + "\nsize = { default = 1.5, contact = 0.8 }"), "first");
  const auto second = run(whole_file(first / "case.resolved.toml"), "second");
  EXPECT_EQ(read_table(first / "history.csv").without_wall_time(),
            read_table(second / "history.csv").without_wall_time());
  const auto rows = [](const std::filesystem::path& results) {
    ResultTable ledger = read_table(results / "remesh.csv");
    for (auto& row : ledger.rows)
      row[ledger.index("seconds")].clear();
    return ledger.rows;
  };
  EXPECT_EQ(rows(first), rows(second));
}

TEST_F(Remeshing, WouldHaveHelpedARunThatGoesBad) {
  const std::string advice = "a [remesh] section would have replaced the mesh";
  const auto bad = run(pressed_far, "bad");
  EXPECT_TRUE(warns(bad, advice)) << summary(bad).dump(1);
  EXPECT_NE(whole_file(bad / "run.log").find(advice), std::string::npos);
  const auto helped = run(edited(pressed_far, {{"[time]", "[remesh]\n[time]"}}), "helped");
  EXPECT_FALSE(warns(helped, advice));
  EXPECT_GT(summary(helped).at("remeshings").at("number"), 0);
  EXPECT_GT(summary(helped).at("min_quality"), summary(bad).at("min_quality"));
}

TEST_F(Remeshing, WouldHaveHelpedARunWhoseElementsTurnInsideOut) {
  const std::string farther = edited(pressed_far, {{"end = 4.5", "end = 5.5"}});
  write_text(folder_.path() / "tiny.toml", farther);
  const Outcome ended = billet({"run", "tiny.toml", "--quiet", "-o", "bad"}, folder_.path());
  EXPECT_EQ(ended.status, 5) << ended.err;
  const std::string reason = summary(folder_.path() / "bad").at("failure").at("reason");
  EXPECT_NE(reason.find("turns inside out (quality -0.0"), std::string::npos) << reason;
  EXPECT_NE(reason.find("a [remesh] section goes on from there"), std::string::npos) << reason;
  // What stands is what came before.
  const ResultTable history = read_table(folder_.path() / "bad" / "history.csv");
  EXPECT_GT(history.value(history.rows.size() - 1, "min_quality"), -0.05);
  EXPECT_GT(history.value(history.rows.size() - 1, "time"), 4.5);
  const auto helped = run(edited(farther, {{"[time]", "[remesh]\n[time]"}}), "helped");
  EXPECT_GT(summary(helped).at("min_quality"), 0.1);
}

TEST_F(Remeshing, WouldHaveHelpedARunThatTouchesOnOneSide) {
  const std::string pressed_by_a_bar =
      edited(upsetting, {{"analysis = \"axisymmetric\"", "analysis = \"plane-strain\""},
                         {"plane = { point = [0, 7.5], normal = [0, -1] }",
                          "circle = { centre = [0, 17.5], radius = 10 }"}});
  const std::string advice = "at the end punch touches on 1 edge of elements only";
  const auto coarse = run(pressed_by_a_bar, "coarse");
  EXPECT_TRUE(warns(coarse, advice)) << summary(coarse).dump(1);
  EXPECT_TRUE(warns(coarse, "a [remesh] section helps"));
  const auto bound = run(
      edited(pressed_by_a_bar, {{"[time]", "[remesh]\nsize = { min = 2.5 }\n[time]"}}), "bound");
  EXPECT_TRUE(warns(bound, "a smaller remesh.size.min would")) << summary(bound).dump(1);
  const auto fine = run(edited(pressed_by_a_bar, {{"cells = [2, 3]", "cells = [32, 3]"}}), "fine");
  EXPECT_FALSE(warns(fine, "touches on")) << summary(fine).dump(1);
  EXPECT_FALSE(warns(run(upsetting, "flat"), "touches on")) << "from corner to corner";
}

TEST_F(Remeshing, IsDescribedByCheck) {
  const Outcome plain = check(upsetting);
  EXPECT_TRUE(plain.prints(", no remeshing")) << plain.out;
  const Outcome usual = check(remeshed(""));
  EXPECT_TRUE(usual.prints(
      "remeshing with tri6 when an element is worse than 0.35 (0.2 in new meshes) or increments "
      "fail, a tool touches on fewer than three edges; edges of 0.3125 to "
      "2.5 mm"))
      << usual.out;
  const Outcome all = check(remeshed("when = { quality = 0.1, strain = 0.5, interval = 0.03, "
                                     "penetration = 0.004 }\nsize = { default = 1, min = 0.3, "
                                     "max = 2 }"));
  EXPECT_TRUE(all.prints("worse than 0.1 or increments fail, a tool touches on fewer than three "
                         "edges, plastic strain has grown by 0.5, "
                         "every 0.03 s, a face lies 0.004 mm deep in a tool; edges of 0.3 to 2 mm"))
      << all.out;
}

} // namespace

} // namespace billet::test::remeshing_test
