// Runs that go on from checkpoints, as a user starts them.

#include "tests/app/case_run.h"
#include "tests/support/case_texts.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace billet::test::resume_test {
namespace {

namespace fs = std::filesystem;

const std::string stored_often = upsetting + "\n[output]\nevery = 0.02\ncheckpoint_every = 0.001\n";

bool has_no_clock(const fs::path& file) {
  return file.extension() != ".checkpoint" && file.filename() != "history.csv" &&
         file.filename() != "starts.json" && file.filename() != "summary.json";
}

class Resume : public CaseRun {
protected:
  Outcome start(const std::string& text, const std::vector<std::string>& more = {}) const {
    write_text(folder_.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml", "--quiet", "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return billet(words, folder_.path());
  }
  [[nodiscard]] fs::path results(const std::string& name) const { return folder_.path() / name; }
  /// Column of a table as text.
  [[nodiscard]] std::vector<double> column(const std::string& folder,
                                           const std::string& name) const {
    return read_table(results(folder) / "history.csv").values(name);
  }
};

TEST_F(Resume, ProlongsARunThatHasEnded) {
  const std::string longer = edited(stored_often, {{"end = 0.1", "end = 0.2"}});
  ASSERT_EQ(start(longer, {"-o", "whole"}).status, 0);
  ASSERT_EQ(start(stored_often, {"-o", "parts"}).status, 0);
  const Outcome outcome = start(longer, {"-o", "parts", "--resume"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<double> whole = column("whole", "punch.force_y");
  const std::vector<double> parts = column("parts", "punch.force_y");
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    EXPECT_NEAR(parts[i], whole[i], 1e-5 * whole[i]); // but for what the linear solver forgets
  EXPECT_DOUBLE_EQ(column("parts", "time").back(), 0.2);
}

TEST_F(Resume, HasTheIncrementsOfTheLongerRun) {
  const std::string usual = edited(upsetting, {{"increments = { first = 0.02, max = 0.02 }\n", ""},
                                               {"[0, -1] }\nfriction", "[0, -0.01] }\nfriction"}});
  const auto ends = [&](const std::string& end) {
    return edited(usual, {{"end = 0.1", "end = " + end}});
  };
  ASSERT_EQ(start(ends("0.1"), {"-o", "out"}).status, 0);
  ASSERT_EQ(start(ends("50"), {"-o", "out", "--resume"}).status, 0);
  EXPECT_LT(column("out", "time").size(), 300U); // those of the shorter one would be 25 000
}

TEST_F(Resume, LeavesOneListOfFramesIfTheCaseHasAnotherName) {
  ASSERT_EQ(start(stored_often, {"-o", "parts"}).status, 0);
  write_text(folder_.path() / "longer.toml", edited(stored_often, {{"end = 0.1", "end = 0.12"}}));
  const Outcome outcome =
      billet({"run", "longer.toml", "--quiet", "-o", "parts", "--resume"}, folder_.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(results("parts") / "case.pvd"));
  EXPECT_TRUE(fs::exists(results("parts") / "longer.pvd"));
}

TEST_F(Resume, TriesNoShorterIncrementsThanTheCaseAllows) {
  const std::string coarse =
      edited(stored_often, {{"end = 0.1", "end = 8"},
                            {"{ first = 0.02, max = 0.02 }", "{ first = 4, min = 3, max = 4 }"}});
  const Outcome failed = start(coarse, {"-o", "failed"});
  ASSERT_EQ(failed.status, 5) << failed.err;
  const Outcome again = start(coarse, {"-o", "failed", "--resume"});
  EXPECT_EQ(again.status, 5) << again.err;
  EXPECT_TRUE(again.says("increments down to 3")) << again.err;
}

TEST_F(Resume, BranchesIntoAnotherFolder) {
  ASSERT_EQ(start(stored_often, {"-o", "first"}).status, 0);
  const std::string before = whole_file(results("first") / "history.csv");
  const std::string longer = edited(stored_often, {{"end = 0.1", "end = 0.2"}});
  const Outcome outcome = start(longer, {"-o", "second", "--from", "first@0.09"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(whole_file(results("first") / "history.csv"), before);
  const std::vector<double> times = column("second", "time");
  ASSERT_FALSE(times.empty());
  EXPECT_GT(times.front(), 0.08);
  EXPECT_DOUBLE_EQ(times.back(), 0.2);
  EXPECT_EQ(start(longer, {"-o", "first", "--from", "first"}).status, 2);
  EXPECT_EQ(start(longer, {"-o", "third", "--from", "first@soon"}).status, 2);
  EXPECT_EQ(start(longer, {"-o", "third", "--from", "first@0.001"}).status, 6);
}

TEST_F(Resume, RefusesACaseThatHasChanged) {
  ASSERT_EQ(start(stored_often, {"-o", "out"}).status, 0);
  const std::string before = whole_file(results("out") / "summary.json");
  const Outcome outcome =
      start(edited(stored_often, {{"m = 0.08", "m = 0.1"}}), {"-o", "out", "--resume"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("friction.m was 0.08, is 0.1"), std::string::npos) << outcome.err;
  EXPECT_EQ(whole_file(results("out") / "summary.json"), before);
}

TEST_F(Resume, RefusesAnEndThatIsBehind) {
  ASSERT_EQ(start(stored_often, {"-o", "out"}).status, 0);
  const Outcome outcome =
      start(edited(stored_often, {{"end = 0.1", "end = 0.05"}}), {"-o", "out", "--resume"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.says("is at time 0.1, beyond the end")) << outcome.err;
}

TEST_F(Resume, TakesTheCheckpointBeforeADamagedOne) {
  ASSERT_EQ(start(stored_often, {"-o", "out"}).status, 0);
  std::map<fs::path, std::string> before;
  for (const auto& entry : fs::recursive_directory_iterator(results("out")))
    if (entry.is_regular_file() && has_no_clock(entry.path()))
      before[entry.path()] = whole_file(entry.path());
  ASSERT_GT(before.size(), 15u);
  fs::path last;
  for (const auto& entry : fs::directory_iterator(results("out") / "checkpoints"))
    last = std::max(last, entry.path());
  fs::resize_file(last, fs::file_size(last) / 2);
  const Outcome outcome = start(stored_often, {"-o", "out", "--resume"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("is damaged"), std::string::npos) << outcome.err;
  for (const auto& [file, bytes] : before)
    EXPECT_TRUE(whole_file(file) == bytes) << file;
}

TEST_F(Resume, SaysWhereThereIsNothingToGoOnFrom) {
  const Outcome outcome = start(stored_often, {"-o", "nowhere", "--resume"});
  EXPECT_EQ(outcome.status, 6);
  EXPECT_NE(outcome.err.find("there is nothing to go on from"), std::string::npos) << outcome.err;
}

TEST_F(Resume, InfoTellsWhatACheckpointHolds) {
  ASSERT_EQ(start(stored_often, {"-o", "out"}).status, 0);
  fs::path last;
  for (const auto& entry : fs::directory_iterator(results("out") / "checkpoints"))
    last = std::max(last, entry.path());
  const Outcome outcome = billet({"info", last.string()}, folder_.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Tiny upsetting"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("end of the run"), std::string::npos) << outcome.out;
}

} // namespace
} // namespace billet::test::resume_test
