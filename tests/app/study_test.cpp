// Studies, charts and identification as a user starts them.

#include "tests/app/case_run.h"
#include "tests/support/case_texts.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace billet::test::study_test {
namespace {

namespace fs = std::filesystem;

const std::string measured_upsetting = upsetting + R"(
[[measure]]
name = "barrelling"
kind = "barrelling"
tool = "punch"

[[measure]]
name = "half_height"
kind = "height"
)";

const std::string study_text = R"(title = "Tiny study"
case  = "case.toml"

[[vary]]
name   = "m"
key    = "tool.punch.friction.m"
values = [0, 0.1, 0.2]

[[vary]]
name   = "mesh"
key    = "workpiece.mesh.cells"
values = [[1, 2], [2, 3], [4, 6]]
sizes  = [4, 2, 1]

[[quantity]]
name = "force"
of   = "punch.force_y"

[[quantity]]
name = "ratio"
expression = "force / 1000"

[trade]
reference  = "finest"
quantities = ["force"]
cost       = "iterations"

[convergence]
quantities = ["force"]
)";

class StudyRun : public CaseRun {
protected:
  StudyRun() { write_text(folder_.path() / "case.toml", measured_upsetting); }
  Outcome study(const std::string& text, const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / "study.toml", text);
    std::vector<std::string> words{"study", "study.toml", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return billet(words, folder_.path());
  }
  [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }
  /// study.csv without what depends on the machine: processor time, memory, folders.
  [[nodiscard]] std::vector<std::string> rows() const {
    std::vector<std::string> lines;
    std::istringstream text(whole_file(out() / "study.csv"));
    for (std::string line; std::getline(text, line);)
      lines.push_back(line.substr(0, line.find(",0.")));
    return lines;
  }
};

TEST_F(StudyRun, TellsTheTradeAndTheExtrapolatedValues) {
  const Outcome outcome = study(study_text);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("| [4, 6] | 0 % |")) << outcome.out;
  EXPECT_TRUE(outcome.prints("The cheapest within 1 %:"));
  EXPECT_TRUE(outcome.prints("9 row(s), 0 of them failed"));
  const nlohmann::json json = nlohmann::json::parse(whole_file(out() / "study.json"));
  EXPECT_EQ(json.at("rows").size(), 9U);
  EXPECT_EQ(json.at("convergence").size(), 3U);
  EXPECT_GT(json.at("rows")[8].at("quantities").at("force").get<double>(),
            json.at("rows")[2].at("quantities").at("force").get<double>());
  EXPECT_NEAR(json.at("rows")[0].at("quantities").at("ratio").get<double>(),
              1e-3 * json.at("rows")[0].at("quantities").at("force").get<double>(), 1e-9);
}

TEST_F(StudyRun, DoesNotDoAgainWhatIsDone) {
  ASSERT_EQ(study(study_text).status, 0);
  const std::string before = whole_file(out() / "study.csv");
  const Outcome again = study(study_text);
  EXPECT_TRUE(again.says("9 rows, 0 runs to be made")) << again.err;
  EXPECT_EQ(whole_file(out() / "study.csv"), before);
  const Outcome more = study(edited(study_text, {{"[0, 0.1, 0.2]", "[0, 0.1, 0.15, 0.2]"}}));
  EXPECT_TRUE(more.says("12 rows, 3 runs to be made")) << more.err;
  // Another case is another run.
  write_text(folder_.path() / "case.toml", edited(measured_upsetting, {{"n = 0.2", "n = 0.25"}}));
  EXPECT_TRUE(study(study_text).says("9 rows, 9 runs to be made"));
}

TEST_F(StudyRun, HasARowWithItsReasonForARunThatFails) {
  const Outcome outcome =
      study(edited(study_text, {{"values = [0, 0.1, 0.2]", "values = [0, 0.1, -1]"},
                                {"[trade]\nreference  = \"finest\"\nquantities = "
                                 "[\"force\"]\ncost       = \"iterations\"\n",
                                 ""}}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("9 row(s), 3 of them failed")) << outcome.out;
  EXPECT_TRUE(outcome.says("failed, 3 row(s): ")) << outcome.err;
  EXPECT_NE(whole_file(out() / "study.csv").find("punch.friction.m: found -1"), std::string::npos);
}

TEST_F(StudyRun, HasAReasonForAQuantityThatIsNoNumber) {
  const Outcome outcome =
      study(edited(study_text, {{"of   = \"punch.force_y\"", "of   = \"ln(0 * time)\""}}));
  EXPECT_TRUE(outcome.prints("9 of them failed")) << outcome.out;
  EXPECT_TRUE(outcome.says("quantity 'force' is not a finite number")) << outcome.err;
}

TEST_F(StudyRun, SaysBeforeTheRunsWhatIsWrong) {
  for (const auto& [with, says] : std::vector<std::pair<std::string, std::string>>{
           {edited(study_text, {{"punch.force_y", "punch.force_y +"}}), "expression"},
           {edited(study_text, {{"punch.force_y", "punch.forec_y"}}), "did you mean"},
           {edited(study_text, {{"[4, 2, 1]", "[1, 1, 2]"}}), "two values have the same size"},
           {edited(study_text, {{"workpiece.mesh.cells", "tool.punch.friction.m"}}),
            "axis 'm' sets tool.punch.friction.m, and axis 'mesh' sets"}}) {
    const Outcome outcome = study(with);
    EXPECT_EQ(outcome.status, 3) << says;
    EXPECT_TRUE(outcome.says(says)) << outcome.err;
    EXPECT_FALSE(fs::exists(out() / "study.csv"));
  }
}

TEST_F(StudyRun, WithoutQuantitiesIsGoodWhereItsRunsAre) {
  const Outcome outcome =
      study("case = \"case.toml\"\n[[vary]]\nkey = \"tool.punch.friction.m\"\nvalues = [0, 0.1]\n");
  EXPECT_TRUE(outcome.prints("2 row(s), 0 of them failed")) << outcome.out;
}

TEST_F(StudyRun, NoticesThatAnIncludedMeshHasChanged) {
  write_text(folder_.path() / "nodes.inp", "*NODE\n1,0,0\n2,10,0\n3,10,7.5\n4,0,7.5\n");
  write_text(folder_.path() / "part.inp",
             "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=CAX4, ELSET=ALL\n1,1,2,3,4\n");
  const std::string text = "case = \"case.toml\"\nset = { \"workpiece.mesh\" = { file = "
                           "\"part.inp\" } }\n[[quantity]]\nname = \"v\"\nof = \"volume\"\n";
  EXPECT_TRUE(study(text).says("1 runs to be made"));
  EXPECT_TRUE(study(text).says("0 runs to be made"));
  write_text(folder_.path() / "nodes.inp", "*NODE\n1,0,0\n2,9,0\n3,9,7.5\n4,0,7.5\n");
  EXPECT_TRUE(study(text).says("1 runs to be made"));
}

TEST_F(StudyRun, GoesOnAfterItWasKilled) {
  const std::string longer =
      edited(study_text,
             {{"case  = \"case.toml\"", "case  = \"case.toml\"\nset = { \"time.end\" = 2.5 }"}});
  write_text(folder_.path() / "study.toml", longer);
  {
    Program program({{"study", "study.toml", "-o", "out"}, folder_.path()});
    ASSERT_TRUE(program.wait_until([&] {
      std::size_t ended = 0;
      std::error_code error;
      for (const auto& each : fs::directory_iterator(out() / "runs", error))
        ended += fs::exists(each.path() / "exit_status") ? 1 : 0;
      return ended >= 2;
    }));
    program.signal(SIGKILL);
    (void)program.end();
  }
  const Outcome after = study(longer);
  EXPECT_EQ(after.status, 0) << after.err;
  EXPECT_FALSE(after.says("9 runs to be made"));
  EXPECT_TRUE(after.prints("9 row(s), 0 of them failed")) << after.out;
}

TEST_F(StudyRun, WritesCommandsForAnyOtherQueue) {
  const Outcome first = study(study_text, {"--set", "run.engine=commands"});
  EXPECT_EQ(first.status, 1) << first.err; // not all is run
  EXPECT_TRUE(first.prints("9 are left to be run")) << first.out;
  ASSERT_EQ(std::system(("sh '" + (out() / "commands.txt").string() + "'").c_str()), 0);
  const Outcome second = study(study_text, {"--set", "run.engine=commands"});
  EXPECT_TRUE(second.prints("9 row(s), 0 of them failed")) << second.out;
}

TEST_F(StudyRun, OfASlurmThatIsNotThereSaysSo) {
  if (fs::exists("/usr/bin/sbatch"))
    GTEST_SKIP() << "it is there";
  const Outcome outcome = study(study_text, {"--set", "run.engine=slurm"});
  EXPECT_EQ(outcome.status, 6);
  EXPECT_TRUE(outcome.says("sbatch")) << outcome.err;
}

/// Stands in for Slurm's sbatch and scancel.
class StudyBySlurm : public StudyRun {
protected:
  StudyBySlurm() {
    fs::create_directory(bin());
    put("sbatch",
        R"sh(case "$*" in *--quiet*) ;; *--parsable*) echo 7 ;; *) echo Submitted batch job 7 ;; esac
for word in "$@"; do script=$word; case $word in --array=1-*) n=${word#--array=1-} ;; esac; done
for i in $(seq "$n"); do SLURM_ARRAY_TASK_ID=$i bash "$script"; sleep "${PAUSE:-0}"; done
)sh");
    put("scancel", "echo \"$1\" >cancelled\n");
  }
  [[nodiscard]] Start start(const std::vector<std::string>& more, const std::string& pause) const {
    std::vector<std::string> words{"study", "study.toml", "-o", "out", "--set", "run.engine=slurm"};
    words.insert(words.end(), more.begin(), more.end());
    return {words, folder_.path(), [path = bin().string() + ":/usr/bin:/bin", pause] {
              ::setenv("PATH", path.c_str(), 1);
              ::setenv("PAUSE", pause.c_str(), 1);
            }};
  }
  [[nodiscard]] fs::path bin() const { return folder_.path() / "bin"; }

private:
  void put(const std::string& name, const std::string& text) const {
    write_text(bin() / name, "#!/bin/bash\n" + text);
    fs::permissions(bin() / name, fs::perms::owner_all);
  }
};

TEST_F(StudyBySlurm, TakesWhateverItsOptionsMakeSbatchSay) {
  write_text(folder_.path() / "study.toml", study_text);
  for (const char* option : {"--comment=a", "--parsable", "--quiet"}) {
    const Outcome outcome =
        Program(start({"--set", std::string("run.options=[\"") + option + "\"]"}, "0")).end();
    EXPECT_EQ(outcome.status, 0) << option << outcome.err;
    EXPECT_TRUE(outcome.prints("9 row(s), 0 of them failed")) << outcome.out;
    fs::remove_all(out());
  }
}

TEST_F(StudyBySlurm, TakesItsJobOutOfTheQueueWhenStopped) {
  write_text(folder_.path() / "study.toml", study_text);
  Program program(start({}, "30"));
  while (!fs::exists(out() / "slurm.txt") || whole_file(out() / "slurm.txt").empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGTERM);
  const Outcome outcome = program.end();
  EXPECT_EQ(outcome.status, 143) << outcome.err;
  EXPECT_EQ(whole_file(folder_.path() / "cancelled"), "7\n");
}

TEST_F(StudyRun, OfAChartGivesTheCoefficientBack) {
  write_text(folder_.path() / "case.toml",
             edited(measured_upsetting, {{"end = 0.1", "end = 2.5"}, {"max = 0.02", "max = 0.1"}}));
  write_text(folder_.path() / "chart.toml", R"(title = "Tiny chart"
case = "case.toml"
[x]
name = "reduction"
of = "1 - half_height / 7.5"
values = [0.1, 0.2, 0.3]
[[y]]
name = "barrelling"
[[law]]
name = "tresca"
parameters = [{ name = "m", key = "tool.punch.friction.m", values = [0, 0.1, 0.2] }]
[[law]]
name = "coulomb"
set = { "tool.punch.friction" = { law = "coulomb", mu = 0.1 } }
parameters = [{ name = "mu", key = "tool.punch.friction.mu", values = [0, 0.05, 0.1] }]
)");
  const Outcome chart = billet({"chart", "chart.toml", "-o", "chart"}, folder_.path());
  ASSERT_EQ(chart.status, 0) << chart.err;
  const ResultTable table = read_table(folder_.path() / "chart" / "chart.csv");
  EXPECT_EQ(whole_file(folder_.path() / "chart" / "chart.csv").substr(0, 8), "law,para");
  const std::vector<double> values = table.values("barrelling");
  write_text(folder_.path() / "measured.csv", "reduction,barrelling,barrelling_standard\n0.2," +
                                                  std::to_string(values[4]) + ",0.001\n");
  const Outcome found =
      billet({"identify", "chart", "measured.csv", "-o", "found"}, folder_.path());
  ASSERT_EQ(found.status, 0) << found.err;
  const nlohmann::json json =
      nlohmann::json::parse(whole_file(folder_.path() / "found" / "identification.json"));
  EXPECT_NEAR(json.at("laws")[0].at("parameters")[0].at("value").get<double>(), 0.1, 2e-3);
  EXPECT_EQ(json.at("laws").size(), 2U);
  EXPECT_EQ(billet({"identify", "chart"}, folder_.path()).status, 2);
}

} // namespace
} // namespace billet::test::study_test
