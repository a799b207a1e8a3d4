// The command line as a user types it: help, mistakes, overrides, what `check` and `info` tell.

#include "io/tools/step.h"
#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <functional>

namespace billet::test::command_line_test {

namespace {

class CommandLine : public testing::Test {
protected:
  CommandLine() { write_text(folder_.path() / "tiny.toml", upsetting); }

  [[nodiscard]] Outcome run(std::vector<std::string> words) const {
    return billet(std::move(words), folder_.path());
  }
  [[nodiscard]] double last_force(const std::string& results) const {
    const ResultTable history = read_table(folder_.path() / results / "history.csv");
    return history.value(history.rows.size() - 1, "punch.force_y");
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }

  TemporaryFolder folder_;
};

TEST_F(CommandLine, help_and_version_answer_on_standard_output) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"-h"}, {"help"}, {"run", "--help"}, {"check", "-h"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.prints("billet")) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
  const Outcome help = run({"--help"});
  for (const char* piece : {"run", "check", "info", "render", "Exit status", "130/143"})
    EXPECT_TRUE(help.prints(piece)) << piece;
  for (const char* piece : {"-o DIR, --output DIR", "--set KEY=VALUE", "--threads N", "--quiet"})
    EXPECT_TRUE(run({"run", "--help"}).prints(piece)) << piece;
  for (const char* piece :
       {"--flow-lines N", "--size WxH", "--curve", "--animate", "-o, --output FILE"})
    EXPECT_TRUE(run({"render", "--help"}).prints(piece)) << piece;
  EXPECT_FALSE(run({"check", "--help"}).prints("--profile"));
  EXPECT_FALSE(run({"info", "--help"}).prints("--threads"));
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(version.out.starts_with("billet ")) << version.out;
  EXPECT_EQ(version.err, "");
}

TEST_F(CommandLine, check_counts_no_clamped_face_among_those_to_touch_however_the_part_is_turned) {
  for (const double angle : {0.0, 0.6}) {
    std::string mesh = "*NODE\n";
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        mesh += fmt::format("{}, {:.17g}, {:.17g}\n", 3 * j + i + 1,
                            i * std::cos(angle) - j * std::sin(angle),
                            i * std::sin(angle) + j * std::cos(angle));
    mesh += "*ELEMENT, TYPE=CPE4\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n3, 4, 5, 8, 7\n4, 5, 6, 9, 8\n"
            "*NSET, NSET=foot\n1, 2, 3\n";
    write_text(folder_.path() / "part.inp", mesh);
    write_text(folder_.path() / "clamped.toml", R"(analysis = "plane-strain"
workpiece = { element = "quad4", material = "steel", mesh = { file = "part.inp" } }
material.steel = { elastic = { young = 2e5, poisson = 0.3 }, flow = { law = "perfect", yield = 300 } }
support = [{ where = "set:foot", fix = ["x", "y"] }]
time = { end = 1 }

[[tool]]
name    = "punch"
surface = { circle = { centre = [20, 20], radius = 1 } }
motion  = { velocity = [0, 0] }
)");
    const Outcome outcome = run({"check", "clamped.toml"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(outcome.prints("6 of the boundary faces may be touched")) << outcome.out;
  }
}

TEST_F(CommandLine, mistakes_end_with_status_2_and_say_what_to_do) {
  struct Mistake {
    std::vector<std::string> words;
    std::string says;
  };
  for (const auto& [words, says] : std::vector<Mistake>{
           {{}, "'billet --help'"},
           {{"rnu", "tiny.toml"}, "did you mean 'run'?"},
           {{"--halp"}, "unknown command"},
           {{"study"}, "a file is missing"},
           {{"identify", "a", "b", "c"}, "two files are expected, 'c' is too many"},
           {{"run"}, "a file is missing"},
           {{"run", ""}, "a file is missing"},
           {{"run", "tiny.toml", "more.toml"}, "'more.toml' is too many"},
           {{"run", "tiny.toml", "--thread", "2"}, "did you mean '--threads'?"},
           {{"info", "tiny.toml", "--threads", "2"}, "unknown option '--threads'"},
           {{"info", "tiny.toml", "--uni", "mm"}, "did you mean '--unit'?"},
           {{"run", "tiny.toml", "--threads", "0"}, "at least 1, not '0'"},
           {{"run", "tiny.toml", "--threads", "-3"}, "at least 1, not '-3'"},
           {{"run", "tiny.toml", "--threads", "two"}, "at least 1, not 'two'"},
           {{"run", "tiny.toml", "--threads=99999999999"}, "at least 1, not '99999999999'"},
           {{"run", "tiny.toml", "--threads"}, "--threads needs a value"},
           {{"run", "tiny.toml", "-o"}, "-o needs a value"},
           {{"run", "tiny.toml", "-o", ""}, "-o needs the name of a folder"},
           {{"run", "tiny.toml", "--set"}, "--set needs a value"},
           {{"run", "tiny.toml", "--resume", "--from", "x"}, "exclude each other"},
           {{"run", "tiny.toml", "--from", "x@soon"}, "RESULTS or RESULTS@TIME, not 'x@soon'"},
           {{"check", "tiny.toml", "--allow-outside=no"}, "--allow-outside takes no value"},
           {{"run", "tiny.toml", "--quiet=yes"}, "leave out '=yes'"},
           {{"render", "x", "--no-mesh=1"}, "--no-mesh takes no value"},
           {{"info"}, "a file is missing"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_TRUE(outcome.says(says)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(exists("results"));
}

TEST_F(CommandLine, a_case_file_must_be_a_file) {
  const std::string endless(300, 'a');
  for (const std::string& file : {std::string("none.toml"), std::string("."), endless,
                                  std::string("/dev/null"), std::string(BILLET_PROGRAM)}) {
    for (const char* command : {"run", "check"}) {
      const Outcome outcome = run({command, file});
      EXPECT_EQ(outcome.status, 3) << outcome.err;
      EXPECT_TRUE(outcome.says(file)) << outcome.err;
    }
  }
  EXPECT_TRUE(run({"run", "none.toml"}).says("there is no such file"));
  EXPECT_TRUE(run({"run", "."}).says("this is a folder"));
}

TEST_F(CommandLine, results_go_to_a_folder_called_like_the_case) {
  EXPECT_EQ(run({"run", "tiny.toml", "--quiet"}).status, 0);
  EXPECT_TRUE(exists("results/tiny/tiny.pvd"));
  // case.toml is called like its folder, however its path is written.
  std::filesystem::create_directory(folder_.path() / "ring");
  write_text(folder_.path() / "ring/case.toml", upsetting);
  for (const char* file : {"ring/case.toml", "./ring/./case.toml", "ring/../ring/case.toml"}) {
    EXPECT_EQ(run({"run", file, "--quiet"}).status, 0);
    EXPECT_TRUE(exists("results/ring/ring.pvd")) << file;
    std::filesystem::remove_all(folder_.path() / "results/ring");
  }
  for (const char* file : {"case.toml", "./case.toml"}) {
    EXPECT_EQ(billet({"run", file, "--quiet"}, folder_.path() / "ring").status, 0);
    EXPECT_TRUE(exists("ring/results/ring/ring.pvd")) << file;
    std::filesystem::remove_all(folder_.path() / "ring/results");
  }
}

TEST_F(CommandLine, overrides_change_the_run) {
  EXPECT_EQ(run({"run", "tiny.toml", "--quiet", "-o", "a"}).status, 0);
  EXPECT_EQ(
      run({"run", "tiny.toml", "--quiet", "-o", "b", "--set", "material.steel.flow.K=1480"}).status,
      0);
  EXPECT_EQ(run({"run", "tiny.toml", "--quiet", "-o", "c", "--set=tool.punch.friction.m=0.9",
                 "--set", "support.1.fix=[\"x\", \"y\"]"})
                .status,
            0);
  EXPECT_GT(last_force("b"), 1.7 * last_force("a"));
  EXPECT_GT(last_force("c"), 1.005 * last_force("a"));
  const std::string resolved = whole_file(folder_.path() / "c/case.resolved.toml");
  EXPECT_NE(resolved.find("m = 0.9"), std::string::npos);
}

TEST_F(CommandLine, bad_overrides_end_with_status_3) {
  struct Mistake {
    std::string set;
    std::string says;
  };
  for (const auto& [set, says] :
       std::vector<Mistake>{{"time.end", "KEY=VALUE"},
                            {"=3", "KEY=VALUE"},
                            {"tool.punhc.friction.m=1", "did you mean 'punch'?"},
                            {"tool.punch.friction.n=1", "unknown key"},
                            {"tool.7.friction.m=1", "there is no tool.7"},
                            {"time.end=nan", "finite"},
                            {"time.end=[1, 2", "--set time.end=[1, 2"},
                            {"material.steel.elastic.poisson=0.6", "poisson: found 0.6"},
                            {"title.x=1", "title"},
                            {"workpiece.element=hex27", "hex27"}}) {
    const Outcome outcome = run({"run", "tiny.toml", "--quiet", "--set", set, "-o", "out"});
    EXPECT_EQ(outcome.status, 3) << set << ": " << outcome.err;
    EXPECT_TRUE(outcome.says(says)) << set << ": " << outcome.err;
  }
  EXPECT_FALSE(exists("out"));
}

TEST_F(CommandLine, progress_goes_to_standard_error_without_colour_or_not_at_all) {
  Start start{{"run", "tiny.toml"}, folder_.path(), [] { ::setenv("NO_COLOR", "1", 1); }};
  const Outcome loud = billet(start);
  EXPECT_EQ(loud.status, 0);
  EXPECT_TRUE(loud.says("increment    1"));
  EXPECT_EQ(loud.err.find('\033'), std::string::npos);
  EXPECT_EQ(loud.err.find('\r'), std::string::npos);
  EXPECT_TRUE(loud.prints("done at time 0.1 s"));
  EXPECT_TRUE(loud.prints("results: results/tiny"));
  const Outcome quiet = run({"run", "tiny.toml", "--quiet"});
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.err, "");
  EXPECT_TRUE(quiet.prints("tool punch: force"));
}

#if defined(__x86_64__)
TEST_F(CommandLine, kernels_are_those_of_the_processor_unless_the_user_has_chosen) {
  const auto kernels = [&](const std::function<void()>& in_child) {
    return billet(Start{{"run", "tiny.toml"}, folder_.path(), in_child}).err;
  };
  const std::string own = kernels([] { ::unsetenv("OPENBLAS_CORETYPE"); });
  EXPECT_NE(own.find("BLAS kernels "), std::string::npos);
  if (__builtin_cpu_supports("avx2") != 0) { // which Prescott's do without
    EXPECT_EQ(own.find("BLAS kernels Prescott"), std::string::npos) << own;
  }
  const std::string chosen = kernels([] { ::setenv("OPENBLAS_CORETYPE", "Prescott", 1); });
  EXPECT_NE(chosen.find("BLAS kernels Prescott"), std::string::npos) << chosen;
}
#endif

TEST_F(CommandLine, standard_streams_that_are_closed_or_full_do_no_harm) {
  const auto closed = [] {
    for (const int stream : {0, 1, 2})
      ::close(stream);
  };
  EXPECT_EQ(billet(Start{{"run", "tiny.toml", "-o", "a"}, folder_.path(), closed}).status, 6);
  expect_whole_results(folder_.path() / "a", "tiny");
  const Outcome deaf =
      billet(Start{{"check", "tiny.toml"}, folder_.path(), [] { ::close(STDOUT_FILENO); }});
  EXPECT_EQ(deaf.status, 6);
  EXPECT_TRUE(deaf.says("standard output cannot be written")) << deaf.err;
  const auto full = [](int stream) { ::dup2(::open("/dev/full", O_WRONLY), stream); };
  EXPECT_EQ(billet(Start{{"run", "tiny.toml", "-o", "b"}, folder_.path(), [&] { full(2); }}).status,
            0);
  for (const char* command : {"run", "check"}) {
    const Outcome mute = billet(Start{{command, "tiny.toml"}, folder_.path(), [&] { full(1); }});
    EXPECT_EQ(mute.status, 6) << command;
    EXPECT_TRUE(mute.says("standard output cannot be written")) << mute.err;
  }
}

TEST_F(CommandLine, check_tells_size_pairs_and_advice_and_solves_nothing) {
  const Outcome outcome = run({"check", "tiny.toml"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* piece :
       {"Tiny upsetting", "6 quad8 elements, 29 nodes", "material law 'swift'",
        "box (0, 0, 0) to (5, 7.5, 0) mm", "contact pair: workpiece - 'punch', friction tresca",
        "unknowns: 58", "memory: about", "factorization", "the case is good"})
    EXPECT_TRUE(outcome.prints(piece)) << piece << " is not in: " << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(exists("results"));
  const Outcome linear = run({"check", "tiny.toml", "--set", "workpiece.element=quad4"});
  EXPECT_TRUE(linear.prints("\"mixed\" and \"compatible\" are the same")) << linear.out;
  const Outcome loose = run({"check", "tiny.toml", "--set", "support.1.fix=[\"x\"]"});
  EXPECT_EQ(loose.status, 0) << loose.err;
  EXPECT_TRUE(loose.prints("1 rigid motion(s) are held by contact alone")) << loose.out;
}

TEST_F(CommandLine, tools_that_go_through_each_other_are_told_before_and_after_the_run) {
  // A stop next to the specimen, a little too high: the punch is on it after half of its way.
  write_text(folder_.path() / "stop.toml", upsetting + R"(
[[tool]]
name    = "stop"
surface = { points = [[20, 7.3], [30, 7.3], [30, 7.45], [20, 7.45]], closed = true }
)");
  const std::string warning =
      "warning: [tools-meet] tools 'punch' and 'stop' meet at t = 0.05 s at (";
  const Outcome check = run({"check", "stop.toml"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_TRUE(check.prints(warning)) << check.out;
  const Outcome done = run({"run", "stop.toml", "-o", "r"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(done.says(warning)) << done.err;
  for (const char* file : {"run.log", "summary.json"})
    EXPECT_NE(content_of(folder_.path() / "r" / file).find(warning), std::string::npos) << file;
}

TEST_F(CommandLine, info_tells_of_stls_meshes_and_results) {
  write_text(folder_.path() / "die.stl", square_stl(20, 0, true));
  const Outcome stl = run({"info", "die.stl"});
  EXPECT_EQ(stl.status, 0) << stl.err;
  for (const char* piece : {"ASCII STL", "(-20, -20, 0) to (20, 20, 0)", "2 on 4 points, area 1600",
                            "open, 4 border edges in 1 loop"})
    EXPECT_TRUE(stl.prints(piece)) << piece << " is not in: " << stl.out;

  const Outcome inches = run({"info", "die.stl", "--unit", "in"});
  EXPECT_TRUE(inches.prints("(-508, -508, 0) to (508, 508, 0)")) << inches.out;
  EXPECT_EQ(run({"info", "die.stl", "--unit", "acre"}).status, 2);

  write_text(folder_.path() / "part.inp", "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n"
                                          "*ELEMENT, TYPE=CAX4, ELSET=all\n1, 1, 2, 3, 4\n"
                                          "*NSET, NSET=foot\n1, 2\n");
  const Outcome inp = run({"info", "part.inp"});
  EXPECT_EQ(inp.status, 0) << inp.err;
  EXPECT_TRUE(inp.prints("1 quad4 elements, 4 nodes")) << inp.out;
  EXPECT_TRUE(inp.prints("foot: 2 nodes")) << inp.out;

  write_text(folder_.path() / "part.msh",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n"
             "4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n");
  const Outcome msh = run({"info", "part.msh"});
  EXPECT_EQ(msh.status, 0) << msh.err;
  EXPECT_TRUE(msh.prints("1 quad4 elements, 4 nodes")) << msh.out;
  EXPECT_TRUE(msh.prints("worst element quality 1.000")) << msh.out;

  EXPECT_EQ(run({"run", "tiny.toml", "--quiet"}).status, 0);
  const Outcome results = run({"info", "results/tiny"});
  EXPECT_EQ(results.status, 0) << results.err;
  EXPECT_TRUE(results.prints("\"status\": \"done\"")) << results.out;

  write_text(folder_.path() / "results" / "tiny" / "summary.json", "[1");
  const Outcome damaged = run({"info", "results/tiny"});
  EXPECT_EQ(damaged.status, 6);
  EXPECT_TRUE(damaged.says("is damaged")) << damaged.err;
  std::filesystem::remove(folder_.path() / "results" / "tiny" / "summary.json");
  const Outcome going_on = run({"info", "results/tiny"});
  EXPECT_EQ(going_on.status, 6);
  EXPECT_TRUE(going_on.says("billet watch results/tiny")) << going_on.err;
}

TEST_F(CommandLine, info_and_check_take_step_files_where_the_build_can) {
  const std::string die = "grooved-die-mm.step";
  std::filesystem::copy(std::filesystem::path(BILLET_SOURCE_DIR) / "tests/io/step" / die,
                        folder_.path() / die);
  const std::string pressed = R"(analysis = "3d"
[workpiece]
element = "hex8"
material = "steel"
mesh = { box = [[-5, 1, -5], [5, 6, 5]], cells = [2, 2, 2] }
[material.steel]
elastic = { young = 210000, poisson = 0.3 }
[[tool]]
name = "die"
surface = { step = ")" + die + R"(" }
motion = { velocity = [0, 1, 0] }
touch = true
[[support]]
where = "y = 6"
fix = ["x", "y", "z"]
[time]
end = 0.01
)";
  write_text(folder_.path() / "step.toml", pressed);
  const Outcome check = run({"check", "step.toml"});
  const Outcome info = run({"info", die});
  if (io::reads_step()) {
    EXPECT_EQ(check.status, 0) << check.err;
    EXPECT_NE((check.out + check.err).find("grooved-die-mm.step (STEP)"), std::string::npos)
        << check.out << check.err;
    EXPECT_EQ(info.status, 0) << info.err;
    EXPECT_NE(info.out.find("closed, volume 2214"), std::string::npos) << info.out;
  } else {
    EXPECT_EQ(check.status, 4);
    EXPECT_NE(check.err.find("./dev build --step"), std::string::npos) << check.err;
    EXPECT_EQ(info.status, 4);
    EXPECT_NE(info.err.find("this build does not read STEP files"), std::string::npos) << info.err;
  }
  const std::string box = "mesh = { box = [[-5, 1, -5], [5, 6, 5]], cells = [2, 2, 2] }";
  std::string body = pressed;
  body.replace(body.find(box), box.size(), "mesh = { step = \"" + die + "\", size = 6 }");
  body.replace(body.find("hex8"), 4, "tet10");
  body.erase(body.find("[[tool]]"), body.find("[[support]]") - body.find("[[tool]]"));
  body.replace(body.find("y = 6"), 5, "y = -20");
  write_text(folder_.path() / "body.toml", body);
  const Outcome meshed = run({"check", "body.toml"});
  EXPECT_EQ(meshed.status, io::reads_step() ? 0 : 4) << meshed.err;
  EXPECT_NE((meshed.out + meshed.err)
                .find(io::reads_step() ? "grooved-die-mm.step: meshed with" : "--step"),
            std::string::npos)
      << meshed.out << meshed.err;
  const Outcome unit = run({"info", die, "--unit", "mm"});
  EXPECT_EQ(unit.status, 2);
  EXPECT_NE(unit.err.find("knows its unit"), std::string::npos) << unit.err;
}

TEST_F(CommandLine, info_refuses_what_it_cannot_read) {
  write_text(folder_.path() / "bad.stl", "solid x\nfacet\n");
  write_text(folder_.path() / "bad.msh", "");
  std::filesystem::create_directory(folder_.path() / "empty");
  for (const auto& [file, status] :
       std::vector<std::pair<std::string, int>>{{"bad.stl", 4},
                                                {"bad.msh", 4},
                                                {"tiny.toml", 4},
                                                {"empty", 6},
                                                {"none.stl", 6},
                                                {std::string(300, 'a'), 6}}) {
    const Outcome outcome = run({"info", file});
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_TRUE(outcome.says(file)) << outcome.err;
    EXPECT_FALSE(outcome.says("internal error")) << outcome.err;
  }
}

} // namespace

} // namespace billet::test::command_line_test
