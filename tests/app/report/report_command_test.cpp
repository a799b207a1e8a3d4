// billet report and billet watch, as a user starts them.

#include "io/results/folder_lock.h"
#include "tests/app/report/made_results.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

namespace billet::test::report_command_test {
namespace {

namespace fs = std::filesystem;

class ReportCommand : public testing::Test {
protected:
  ReportCommand() { make_results(results()); }
  [[nodiscard]] fs::path results() const { return folder_.path() / "rings"; }
  [[nodiscard]] Outcome call(const std::vector<std::string>& words) const {
    return billet(words, folder_.path());
  }

  TemporaryFolder folder_;
};

TEST_F(ReportCommand, WritesOneFile) {
  write_text(results() / "summary.json", made_summary);
  Outcome outcome = call({"report", "rings"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("report: rings/report.html"));
  EXPECT_TRUE(whole_file(results() / "report.html").starts_with("<!DOCTYPE html>"));
  outcome = call({"report", "rings", "--output", "a.html", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_GT(fs::file_size(folder_.path() / "a.html"), 10'000U);
}

TEST_F(ReportCommand, RefusesWhatItCannotDo) {
  EXPECT_EQ(call({"report"}).status, 2);
  EXPECT_EQ(call({"report", "rings", "-o", "a.pdf"}).status, 2);
  EXPECT_EQ(call({"report", "nowhere"}).status, 6);
  fs::create_directory(folder_.path() / "empty");
  const Outcome outcome = call({"report", "empty"});
  EXPECT_EQ(outcome.status, 6);
  EXPECT_TRUE(outcome.says("holds no results of a run")) << outcome.err;
  EXPECT_TRUE(call({"report", "rings", "--folow"}).says("--follow"));
  EXPECT_EQ(call({"report", "rings", "-o", "no/such/folder.html"}).status, 6);
}

TEST_F(ReportCommand, FollowsARunToItsEnd) {
  std::optional<io::FolderLock> lock(results());
  Program program({.words = {"report", "rings", "--follow"}, .folder = folder_.path()});
  const auto page = [&] { return whole_file(results() / "report.html"); };
  EXPECT_TRUE(program.wait_until([&] { return page().find("running") != std::string::npos; }));
  write_text(results() / "summary.json", made_summary);
  lock.reset();
  const Outcome outcome = program.end();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(page().find("<strong>done</strong>"), std::string::npos);
  EXPECT_EQ(page().find("http-equiv=\"refresh\""), std::string::npos);
  EXPECT_EQ(page().find("<meta name=\"reload-after\""), std::string::npos);
}

TEST_F(ReportCommand, ReportsARunOfTheProgram) {
  write_text(folder_.path() / "case.toml", upsetting);
  ASSERT_EQ(call({"run", "case.toml", "-o", "out", "--quiet"}).status, 0);
  ASSERT_EQ(call({"report", "out"}).status, 0);
  const std::string page = whole_file(folder_.path() / "out" / "report.html");
  for (const char* part : {"<strong>done</strong>", "run case.toml -o out --quiet", "Forces over",
                           "Machine", "Tiny upsetting"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_LT(page.size(), 10'000'000U);
  const Outcome watched = call({"watch", "out"});
  EXPECT_EQ(watched.status, 0) << watched.err;
  EXPECT_TRUE(watched.prints("100 %"));
}

TEST_F(ReportCommand, WatchEndsWithTheStatusOfTheRun) {
  write_text(results() / "summary.json",
             R"({"status": "not-converged", "exit_status": 5, "failure": {"reason": "stuck"}})");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"watch", "rings"}, {"watch", "rings", "--once"}}) {
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.status, 5) << outcome.err;
    EXPECT_TRUE(outcome.prints("failure: stuck"));
    EXPECT_TRUE(outcome.prints("punch")) << outcome.out;
    EXPECT_TRUE(outcome.prints("█")) << outcome.out;
    EXPECT_TRUE(outcome.prints("40 kN")) << outcome.out;
    EXPECT_TRUE(outcome.prints("warning: dies are <small>"));
  }
}

TEST_F(ReportCommand, WatchTellsARunThatWasKilled) {
  const Outcome outcome = call({"watch", "rings"});
  EXPECT_EQ(outcome.status, 137);
  EXPECT_TRUE(outcome.prints("killed before its end"));
  EXPECT_EQ(call({"watch", "nowhere"}).status, 6);
}

TEST_F(ReportCommand, WatchPrintsALineWhenTheRunHasGotOn) {
  std::optional<io::FolderLock> lock(results());
  EXPECT_EQ(call({"watch", "rings", "--once"}).status, 0);
  Program program({.words = {"watch", "rings"}, .folder = folder_.path()});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  write_text(results() / "summary.json", made_summary);
  lock.reset();
  const Outcome outcome = program.end();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints(" 50 %  time 1 s  increment 2")) << outcome.out;
  EXPECT_TRUE(outcome.prints("done, full cavity")) << outcome.out;
  EXPECT_EQ(outcome.out.find('\033'), std::string::npos); // no terminal
}

} // namespace
} // namespace billet::test::report_command_test
