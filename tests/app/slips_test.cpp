// Slips of a beginner: what `check` and `run` say of them, and that they go on.

#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace billet::app::slips_test {
namespace {

using namespace billet::test;

class Slips : public testing::Test {
protected:
  Outcome run(const std::vector<std::string>& words) { return billet(words, folder_.path()); }
  [[nodiscard]] std::filesystem::path at(const std::string& name) const {
    return folder_.path() / name;
  }

  TemporaryFolder folder_;
};

TEST_F(Slips, are_told_by_check_and_run_and_stand_in_the_summary) {
  write_text(at("case.toml"), edited(upsetting, {{"\"tresca\", m = 0.08", "\"coulomb\", mu = 8"},
                                                 {"point = [0, 7.5]", "point = [0, 9]"}}));
  const std::vector<std::string> told{
      "warning: [large-friction] tool 'punch': mu = 8 is more than metals have",
      "warning: [tool-misses] tool 'punch' does not reach the workpiece"};
  const Outcome check = run({"check", "case.toml"});
  EXPECT_EQ(check.status, 0) << check.err;
  const Outcome done = run({"run", "case.toml", "-o", "r"});
  EXPECT_EQ(done.status, 0) << done.err;
  const auto summary = nlohmann::json::parse(whole_file(at("r") / "summary.json"));
  for (const std::string& warning : told) {
    EXPECT_TRUE(check.prints(warning)) << check.out;
    EXPECT_TRUE(done.says(warning)) << done.err;
    EXPECT_TRUE(std::any_of(
        summary.at("warnings").begin(), summary.at("warnings").end(),
        [&](const nlohmann::json& entry) { return entry.get<std::string>().starts_with(warning); }))
        << summary.at("warnings");
  }
}

TEST_F(Slips, explain_why_a_case_cannot_begin) {
  // A punch that is to be turned by 180 degrees holds the workpiece inside as it is.
  write_text(at("case.toml"), edited(upsetting, {{"normal = [0, -1] } }",
                                                  "normal = [0, 1] } }\nplace = { rotate = { "
                                                  "point = [0, 7.5], degrees = 3.1416 } }"}}));
  const Outcome outcome = run({"check", "case.toml"});
  EXPECT_EQ(outcome.status, 4) << outcome.out;
  EXPECT_TRUE(outcome.says("the workpiece overlaps tool 'punch'")) << outcome.err;
  EXPECT_TRUE(outcome.says("in radians it would be 180 degrees")) << outcome.err;
}

/// A profile that is drawn the wrong way round, and how it is put right.
TEST_F(Slips, a_profile_the_wrong_way_round_says_the_rule_and_flip_turns_it) {
  const std::string plane = "{ plane = { point = [0, 7.5], normal = [0, -1] } }";
  const std::string profile =
      "start = [9, 8]\n[[segment]]\nto = [1, 8]\n[[segment]]\nto = [-1, 8]\n";
  write_text(at("punch.toml"), profile);
  for (const std::string surface : {"profile = \"punch.toml\"", "points = [[9, 8], [-1, 8]]"})
    for (const std::string touch : {"false", "true"}) {
      const Edits edits{{plane, "{ " + surface + " }\ntouch = " + touch}};
      write_text(at("turned.toml"), edited(upsetting, edits));
      const Outcome turned = run({"check", "turned.toml"});
      EXPECT_EQ(turned.status, 4) << turned.out;
      EXPECT_TRUE(turned.says("a tool lies on the left of the direction in which its profile runs; "
                              "flip = true puts it on the right"))
          << turned.err;
      write_text(
          at("right.toml"),
          edited(upsetting, {{plane, "{ " + surface + ", flip = true }\ntouch = " + touch}}));
      const Outcome right = run({"check", "right.toml"});
      EXPECT_EQ(right.status, 0) << right.err;
    }
}

TEST_F(Slips, check_tells_of_memory_time_and_free_motions) {
  write_text(at("case.toml"), upsetting);
  const Outcome check = run({"check", "case.toml", "--set", "support.1.fix=[\"x\"]"});
  EXPECT_TRUE(check.prints(" MB that are left")) << check.out;
  EXPECT_TRUE(check.prints("time: about ")) << check.out;
  EXPECT_TRUE(check.prints("held by contact alone (along y)")) << check.out;
}

} // namespace
} // namespace billet::app::slips_test
