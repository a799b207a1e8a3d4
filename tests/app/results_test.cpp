// What a run writes: tables, summary, frames, the resolved case; the same in other units and with
// other numbers of threads.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace billet::test::results_test {

namespace {

const std::string unloading = edited(upsetting, {{"end = 0.1\n", ""}}) + R"(
[[stage]]
name = "press"
end = 0.1

[[stage]]
name = "unload"
end = 0.2
unload = true

[output]
every = 0.03
at = [0.013, 0.15]
)";

class Results : public testing::Test {
protected:
  void put(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
  }
  /// Runs a case and returns its results.
  [[nodiscard]] std::filesystem::path run(const std::string& name,
                                          const std::string& text,
                                          const std::vector<std::string>& more = {}) const {
    put(name + ".toml", text);
    std::vector<std::string> words{"run", name + ".toml", "--quiet", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = billet(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_.path() / name;
  }
  [[nodiscard]] std::filesystem::path run_3d(const std::vector<std::string>& more = {}) const {
    put("punch.stl", square_stl(20, 16, false));
    put("die.stl", square_stl(20, 0, true));
    return run("space", upsetting_3d, more);
  }

  TemporaryFolder folder_;
};

std::string expected_header(const std::vector<std::string>& tools) {
  std::string header = "increment,time,dt,iterations,residual,cutbacks,volume,max_penetration,"
                       "contact_area,plastic_work,external_work,friction_work,elastic_energy,"
                       "max_plastic_strain,min_quality,remeshings,wall_time";
  for (const std::string& tool : tools)
    for (const char* what : {"force", "torque", "displacement"})
      for (const char* axis : {"_x", "_y", "_z"})
        header += "," + tool + "." + what + axis;
  return header;
}

void expect_good_history(const std::filesystem::path& folder,
                         const std::vector<std::string>& tools,
                         double end) {
  const std::string text = whole_file(folder / "history.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), expected_header(tools));
  const ResultTable history = read_table(folder / "history.csv");
  ASSERT_FALSE(history.rows.empty());
  double time = 0.0;
  for (std::size_t row = 0; row < history.rows.size(); ++row) {
    EXPECT_EQ(history.value(row, "increment"), static_cast<double>(row + 1));
    EXPECT_NEAR(history.value(row, "time"), time + history.value(row, "dt"), 1e-12 * end);
    time = history.value(row, "time");
    for (const std::string& cell : history.rows[row]) {
      char again[40];
      const double value = std::strtod(cell.c_str(), nullptr);
      EXPECT_TRUE(std::isfinite(value)) << cell;
      std::snprintf(again, sizeof(again), "%.17g", value);
      EXPECT_EQ(cell, again);
    }
  }
  EXPECT_EQ(time, end);
}

nlohmann::json summary_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(whole_file(folder / "summary.json"));
}

void expect_good_summary(const std::filesystem::path& folder, const std::string& tool) {
  const nlohmann::json summary = summary_of(folder);
  EXPECT_EQ(summary.at("status"), "done");
  EXPECT_EQ(summary.at("exit_status"), 0);
  for (const char* key : {"title", "billet", "units", "analysis", "element", "elements", "nodes",
                          "unknowns", "threads", "increments", "iterations", "cutbacks"})
    EXPECT_TRUE(summary.contains(key)) << key;
  for (const char* key : {"external_work", "elastic_energy", "plastic_work", "friction_work",
                          "contact_energy", "relative_error"})
    EXPECT_TRUE(summary.at("energy").at(key).is_number()) << key;
  // The work of the tools is a trapezoidal sum: an increment across the onset of yield is too much.
  EXPECT_LT(summary.at("energy").at("relative_error"), 0.25);
  for (const nlohmann::json& window :
       {summary.at("process_window"), summary.at("tools").at(tool).at("process_window")}) {
    EXPECT_GT(window.at("contact_time"), 0.0);
    EXPECT_GT(window.at("mean_area"), 0.0);
    for (const char* key : {"pressure", "sliding_speed", "sliding_distance", "surface_strain",
                            "surface_strain_rate"}) {
      EXPECT_LE(window.at(key).at("lowest"), window.at(key).at("mean")) << key;
      EXPECT_LE(window.at(key).at("mean"), window.at(key).at("highest")) << key;
      EXPECT_TRUE(window.at(key).at("last_mean").is_number()) << key;
    }
  }
  for (const char* key : {"total", "search", "contact", "elements", "assembly", "analysis",
                          "factorization", "solve", "output"})
    EXPECT_GE(summary.at("seconds").at(key), 0.0) << key;
  const ResultTable history = read_table(folder / "history.csv");
  EXPECT_EQ(summary.at("increments"), history.rows.size());
  for (const auto& [axis, column] : {std::pair{0, ".force_x"}, {1, ".force_y"}, {2, ".force_z"}})
    EXPECT_EQ(summary.at("tools").at(tool).at("force").at(static_cast<std::size_t>(axis)),
              history.value(history.rows.size() - 1, tool + column));
  double iterations = 0.0;
  for (const double n : history.values("iterations"))
    iterations += n;
  EXPECT_EQ(summary.at("iterations"), iterations);
  EXPECT_EQ(read_table(folder / "iterations.csv").columns,
            (std::vector<std::string>{"increment", "time", "iteration", "residual", "correction",
                                      "step", "contact_changes"}));
}

TEST_F(Results, of_a_run_in_the_plane_are_whole) {
  const auto folder = run("tiny", upsetting);
  expect_good_history(folder, {"punch"}, 0.1);
  expect_good_summary(folder, "punch");
  expect_whole_results(folder, "tiny");
  for (const char* file : {"run.log", "case.resolved.toml"})
    EXPECT_FALSE(whole_file(folder / file).empty()) << file;
  EXPECT_FALSE(std::filesystem::exists(folder / "failure"));
  // Incompressible plasticity and a thousandth of elasticity.
  const ResultTable history = read_table(folder / "history.csv");
  EXPECT_NEAR(history.value(0, "volume"), 3.14159265 * 25.0 * 7.5, 0.01 * 589.0);
  EXPECT_GT(history.value(0, "punch.force_y"), 0.0);
  EXPECT_EQ(history.value(history.rows.size() - 1, "punch.displacement_y"), -0.1);
}

TEST_F(Results, of_a_run_in_space_with_stl_dies_are_whole) {
  const auto folder = run_3d();
  expect_good_history(folder, {"punch", "die"}, 0.1);
  expect_good_summary(folder, "punch");
  expect_whole_results(folder, "space");
  // Brought to touch over a gap of 1; what one die presses the other takes.
  EXPECT_NEAR(summary_of(folder).at("tools").at("punch").at("touch_offset").at(2), -1.0, 1e-9);
  const ResultTable history = read_table(folder / "history.csv");
  const double punch = history.value(history.rows.size() - 1, "punch.force_z");
  const double die = history.value(history.rows.size() - 1, "die.force_z");
  EXPECT_GT(punch, 0.0);
  EXPECT_NEAR(punch, -die, 1e-4 * punch);
  EXPECT_NE(whole_file(folder / "run.log").find("punch.stl"), std::string::npos);
}

TEST_F(Results, the_resolved_case_runs_again_to_the_same_bits) {
  const auto first = run("tiny", unloading, {"--set", "tool.punch.friction.m=0.12"});
  const auto second = run("again", whole_file(first / "case.resolved.toml"));
  EXPECT_EQ(read_table(first / "history.csv").without_wall_time(),
            read_table(second / "history.csv").without_wall_time());
  EXPECT_EQ(whole_file(first / "case.resolved.toml"), whole_file(second / "case.resolved.toml"));
  EXPECT_EQ(whole_file(first / "iterations.csv"), whole_file(second / "iterations.csv"));
}

TEST_F(Results, the_resolved_case_in_space_runs_again_beside_its_dies) {
  const auto first = run_3d();
  const auto second = run("again", whole_file(first / "case.resolved.toml"));
  EXPECT_EQ(read_table(first / "history.csv").without_wall_time(),
            read_table(second / "history.csv").without_wall_time());
}

TEST_F(Results, contact_frames_hold_the_points_of_contact_faces_alone) {
  const auto count = [](const std::string& file, const std::string& of) {
    const std::string key = "NumberOf" + of + "=\"";
    return std::stoi(file.substr(file.find(key) + key.size()));
  };
  const auto frames = run("press", upsetting) / "frames";
  const std::string contact = whole_file(frames / "contact_0001.vtp");
  const int lines = count(contact, "Lines");
  const int points = count(contact, "Points");
  EXPECT_GT(lines, 0);
  EXPECT_TRUE(points == lines + 1 || points == 2 * lines + 1)
      << points << " of " << lines; // a chain
  EXPECT_LT(points, count(whole_file(frames / "workpiece_0001.vtu"), "Points"));
  const auto solid = run_3d() / "frames";
  EXPECT_LT(count(whole_file(solid / "contact_0001.vtp"), "Points"),
            count(whole_file(solid / "workpiece_0001.vtu"), "Points"));
}

TEST_F(Results, frames_are_written_at_the_times_asked_for) {
  const auto folder = run("tiny", unloading);
  const std::vector<double> expected{0.0, 0.013, 0.03, 0.06, 0.09, 0.12, 0.15, 0.18, 0.2};
  const std::vector<double> frames = frame_times(folder / "tiny.pvd");
  ASSERT_EQ(frames.size(), expected.size());
  const std::vector<double> times = read_table(folder / "history.csv").values("time");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(frames[i], expected[i], 1e-15);
    EXPECT_TRUE(i == 0 || std::count(times.begin(), times.end(), frames[i]) == 1) << frames[i];
  }
  expect_whole_results(folder, "tiny");
}

TEST_F(Results, frames_closer_than_increments_are_one_an_increment) {
  const auto folder = run("tiny", upsetting, {"--set", "output.every=1e-7"});
  const std::vector<double> times = read_table(folder / "history.csv").values("time");
  EXPECT_EQ(times.size(), 8U);
  std::vector<double> frames = frame_times(folder / "tiny.pvd");
  frames.erase(frames.begin());
  EXPECT_EQ(frames, times);
}

/// The first warning of a summary that has the words; empty: there is none.
std::string warning_with(const nlohmann::json& summary, const std::string& words) {
  for (const nlohmann::json& entry : summary.at("warnings"))
    if (auto warning = entry.get<std::string>(); warning.find(words) != std::string::npos)
      return warning;
  return "";
}

TEST_F(Results, metal_that_has_no_way_out_is_told) {
  const std::string confined =
      edited(upsetting, {{"[[tool]]", "[[support]]\nwhere = \"x = 5\"\nfix = [\"x\"]\n\n[[tool]]"},
                         {"end = 0.1\nincrements = { first = 0.02, max = 0.02 }",
                          "end = 0.3\n[stop]\non_full_cavity = false"}});
  const auto warning_of = [&](const std::string& out, const std::string& text) {
    return warning_with(summary_of(run(out, text)), "squeezed by more than 1 %");
  };
  // 0.3 mm of 7.5 are gone, less 0.0009 by which the punch sinks in, and nothing but the volume
  // gives way: K ln(7.5 / 7.2009) = 7120 MPa.
  const std::string warning = warning_of("confined", confined);
  EXPECT_NE(warning.find("at the end by 4 %, under 7.12e+03 MPa"), std::string::npos) << warning;
  EXPECT_EQ(warning_of("free", upsetting), "");
}

TEST_F(Results, soft_elasticity_alone_does_not_fill_a_cavity) {
  // E is forty times the yield stress: two of these take 5 % of the volume.
  const std::string plate = edited(
      upsetting,
      {{"[5, 7.5]], cells = [2, 3]", "[10, 1]], cells = [20, 2]"},
       {"\"swift\", K = 740, eps0 = 0.01, n = 0.2", "\"linear\", yield = 5250, hardening = 0"},
       {"point = [0, 7.5]", "point = [0, 1]"},
       {"\"tresca\", m = 0.08", "\"sticking\""},
       {"increments = { first = 0.02, max = 0.02 }", ""},
       {"velocity = [0, -1]", "velocity = [0, -2]"}});
  const auto open = summary_of(run("plate", plate));
  EXPECT_LT(open.at("volume"), 0.96 * 314.159);
  EXPECT_EQ(warning_with(open, "the cavity is full"), "");
  const std::string closed =
      edited(plate, {{"[[tool]]", "[[support]]\nwhere = \"x = 10\"\nfix = [\"x\"]\n\n[[tool]]"}}) +
      "[stop]\non_tools_overloaded = false\n";
  const std::string warning = warning_with(summary_of(run("closed", closed)), "the cavity is full");
  EXPECT_NE(warning.find("its flow stress"), std::string::npos) << warning;
}

TEST_F(Results, metal_that_loses_most_of_its_strength_is_told) {
  const auto warning_of = [&](const std::string& out, const std::string& points) {
    const std::size_t flow = upsetting.find("flow");
    const std::size_t end = upsetting.find('\n', flow);
    const std::string text = upsetting.substr(0, flow) +
                             "flow = { law = \"table\", points = " + points + " }" +
                             upsetting.substr(end);
    return warning_with(summary_of(run(out, text)), "of its largest stress left");
  };
  // The strain is ln(7.5 / 7.4) = 0.0134 less what is elastic.
  const std::string warning = warning_of("soft", "[[0, 400], [0.002, 400], [0.01, 160]]");
  EXPECT_NE(warning.find("the flow law has 40 % of its largest stress left"), std::string::npos)
      << warning;
  EXPECT_EQ(warning_of("hard", "[[0, 400], [0.002, 400], [0.01, 300]]"), "");
}

TEST_F(Results, unloading_leaves_no_force_on_the_tool) {
  const auto folder = run("tiny", unloading);
  const ResultTable history = read_table(folder / "history.csv");
  double pressed = 0.0;
  double last = 0.0;
  for (std::size_t row = 0; row < history.rows.size(); ++row) {
    const double force = history.value(row, "punch.force_y");
    if (history.value(row, "time") <= 0.1) {
      pressed = history.value(row, "elastic_energy");
      EXPECT_GT(force, 1e4);
    } else {
      EXPECT_LT(force, last) << "it draws back";
    }
    last = force > 0.0 ? force : 1e-300; // once it is gone it does not come again
  }
  const std::size_t end = history.rows.size() - 1;
  for (const char* axis : {"_x", "_y", "_z"})
    EXPECT_EQ(history.value(end, std::string("punch.force") + axis), 0.0);
  EXPECT_EQ(history.value(end, "contact_area"), 0.0);
  EXPECT_LT(history.value(end, "elastic_energy"), 0.01 * pressed);
}

TEST_F(Results, only_the_fields_asked_for_are_written) {
  const auto folder = run("tiny", upsetting, {"--set", "output.fields=[\"von_mises\"]"});
  const std::string frame = whole_file(folder / "frames/workpiece_0001.vtu");
  EXPECT_NE(frame.find("Name=\"von_mises\""), std::string::npos);
  EXPECT_EQ(frame.find("Name=\"plastic_strain\""), std::string::npos);
}

TEST_F(Results, a_second_run_into_the_folder_leaves_nothing_of_the_first) {
  const auto folder = run("tiny", upsetting, {"--set", "output.every=0.02"});
  write_text(folder / "frames/notes.txt", "mine");
  write_text(folder / "notes.txt", "mine");
  const auto again = run("tiny", upsetting, {"--set", "output.every=1"});
  EXPECT_TRUE(std::filesystem::exists(folder / "frames/workpiece_0001.vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames/workpiece_0002.vtu"));
  EXPECT_EQ(whole_file(folder / "frames/notes.txt"), "mine");
  EXPECT_EQ(whole_file(folder / "notes.txt"), "mine");
  expect_whole_results(again, "tiny");
  // Nor has one under another name.
  write_text(folder / "mine.pvd", "<VTKFile/>");
  put("other.toml", upsetting);
  ASSERT_EQ(billet({"run", "other.toml", "--quiet", "-o", "tiny"}, folder_.path()).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "other.pvd"));
  EXPECT_FALSE(std::filesystem::exists(folder / "tiny.pvd"));
  EXPECT_TRUE(std::filesystem::exists(folder / "mine.pvd"));
}

TEST_F(Results, do_not_depend_on_the_units) {
  const auto in_mm = run("mm", upsetting);
  const auto in_m = run("m", edited(upsetting, {{"analysis", "units = \"m-N-s-Pa-degC\"\nanalysis"},
                                                {"[5, 7.5]", "[0.005, 0.0075]"},
                                                {"K = 740", "K = 740e6"},
                                                {"point = [0, 7.5]", "point = [0, 0.0075]"},
                                                {"velocity = [0, -1]", "velocity = [0, -0.001]"}}));
  const ResultTable mm = read_table(in_mm / "history.csv");
  const ResultTable m = read_table(in_m / "history.csv");
  EXPECT_EQ(mm.values("iterations"), m.values("iterations"));
  EXPECT_EQ(mm.values("time"), m.values("time"));
  ASSERT_EQ(mm.rows.size(), m.rows.size());
  constexpr double rounding = 1e-9; // Newton's last residual is about 1e-9, its error is smaller
  struct Scaled {
    const char* column;
    double mm_per_m; ///< value in mm over value in m
  };
  for (const auto& [column, factor] : {Scaled{"punch.force_y", 1.0},
                                       {"volume", 1e9},
                                       {"contact_area", 1e6},
                                       {"plastic_work", 1e3},
                                       {"max_plastic_strain", 1.0},
                                       {"punch.displacement_y", 1e3}})
    for (std::size_t row = 0; row < mm.rows.size(); ++row) {
      const double value = mm.value(row, column);
      EXPECT_NEAR(factor * m.value(row, column), value, rounding * std::abs(value)) << column;
    }
}

TEST_F(Results, do_not_depend_on_the_number_of_threads) {
  const std::vector<std::string> fine{"--set", "workpiece.mesh.cells=[12, 18]", "--threads"};
  auto one = fine;
  one.emplace_back("1");
  auto two = fine;
  two.emplace_back("2");
  const auto first = run("one", upsetting, one);
  const auto second = run("two", upsetting, two);
  EXPECT_EQ(read_table(first / "history.csv").without_wall_time(),
            read_table(second / "history.csv").without_wall_time());
  EXPECT_EQ(whole_file(first / "iterations.csv"), whole_file(second / "iterations.csv"));
  EXPECT_EQ(summary_of(second).at("threads"), 2);
}

} // namespace

} // namespace billet::test::results_test
