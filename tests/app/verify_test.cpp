// billet verify, as a user starts it.

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace billet::test::verify_test {
namespace {

namespace fs = std::filesystem;

TEST(Verify, problems_are_run_by_name_and_written_as_markdown_and_html) {
  const TemporaryFolder folder;
  const Outcome outcome =
      billet({"verify", "block-coulomb", "mixed-element", "-o", "out"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_TRUE(outcome.prints("| problem | figure | value | reference | deviation |"));
  EXPECT_TRUE(outcome.prints("| block-coulomb | coulomb: shear at p = 200 MPa"));
  EXPECT_TRUE(outcome.prints("7 figures of 2 problems, all are within their tolerances"));
  EXPECT_TRUE(outcome.says("2/2 mixed-element: ok"));
  const std::string markdown = whole_file(folder.path() / "out" / "verify.md");
  EXPECT_NE(markdown.find("Cescotto et al., eqs 15 and 16"), std::string::npos);
  const std::string html = whole_file(folder.path() / "out" / "verify.html");
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(html.find("</html>"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "the page needs nothing else";
}

TEST(Verify, a_case_that_it_wrote_can_be_run_by_hand) {
  const TemporaryFolder folder;
  ASSERT_EQ(billet({"verify", "block-coulomb", "-o", "out", "--quiet"}, folder.path()).status, 0);
  const Outcome run =
      billet({"run", "out/cases/block-coulomb.toml", "-o", "by-hand", "--quiet"}, folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(fs::exists(folder.path() / "by-hand" / "history.csv"));
}

TEST(Verify, every_problem_is_within_its_tolerances) {
  const TemporaryFolder folder;
  const Outcome outcome = billet({"verify", "--quiet"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_TRUE(outcome.prints("all are within their tolerances")) << outcome.out;
}

TEST(Verify, without_a_folder_nothing_is_left) {
  const TemporaryFolder folder;
  const Outcome outcome = billet(Start{{"verify", "block-tresca", "--quiet"}, folder.path(), [&] {
                                         ::setenv("TMPDIR", folder.path().c_str(), 1);
                                       }});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Verify, the_problems_are_listed_and_unknown_ones_refused) {
  const Outcome list = billet({"verify", "--list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_TRUE(list.prints("block-coulomb-capped"));
  EXPECT_TRUE(list.prints("Hertz 1882"));
  const Outcome unknown = billet({"verify", "hertz-lin"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(unknown.says("did you mean 'hertz-line'?")) << unknown.err;
}

TEST(Verify, a_folder_that_cannot_be_written_ends_with_status_6) {
  const TemporaryFolder folder;
  write_text(folder.path() / "file", "");
  EXPECT_EQ(billet({"verify", "block-coulomb", "-o", "file"}, folder.path()).status, 6);
}

} // namespace
} // namespace billet::test::verify_test
