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

TEST_F(Slips, tell_of_elements_of_another_analysis) {
  const auto told = [&](const std::string& type, const std::string& analysis) {
    write_text(at("part.inp"), "*NODE\n1, 0, 0\n2, 5, 0\n3, 5, 7.5\n4, 0, 7.5\n*ELEMENT, TYPE=" +
                                   type + "\n1, 1, 2, 3, 4\n");
    write_text(at("case.toml"), edited(upsetting, {{"\"axisymmetric\"", "\"" + analysis + "\""},
                                                   {"\"quad8\"", "\"quad4\""},
                                                   {"{ box = [[0, 0], [5, 7.5]], cells = [2, 3] }",
                                                    "{ file = \"part.inp\" }"}}));
    const Outcome check = run({"check", "case.toml"});
    EXPECT_EQ(check.status, 0) << check.err;
    return check.prints("warning: [mesh-analysis] part.inp: " + type);
  };
  EXPECT_TRUE(told("CAX4", "plane-strain"));
  EXPECT_TRUE(told("CPE4", "axisymmetric"));
  EXPECT_TRUE(told("CPS4", "plane-strain"));
  EXPECT_FALSE(told("CAX4R", "axisymmetric"));
  EXPECT_FALSE(told("CPE4", "plane-strain"));
}

TEST_F(Slips, tell_of_a_die_that_turns_across_a_plane_of_symmetry) {
  const auto told = [&](const std::string& motion, const std::string& sector) {
    write_text(at("case.toml"), R"(
analysis = "3d"
[workpiece]
element = "hex8"
material = "m"
mesh = { cylinder = { radius = 5, height = 8 }, cells = [4, 4])" +
                                    sector + R"(
[material.m]
elastic = { young = 200000, poisson = 0.3 }
flow = { law = "swift", K = 500, eps0 = 0.01, n = 0.2 }
[[support]]
where = "z = 0"
fix = ["x", "y", "z"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 0, 8], normal = [0, 0, -1] } }
friction = { law = "coulomb", mu = 0.3 }
motion = { velocity = [0, 0, -1])" + motion +
                                    R"( }
[time]
end = 1
)");
    const Outcome check = run({"check", "case.toml"});
    EXPECT_EQ(check.status, 0) << check.err;
    return check.prints("[turns-across-symmetry] tool 'die'");
  };
  const std::string turn = ", rotation = { point = [0, 0, 0], axis = [0, 0, 1], speed = 0.5 }";
  const std::string quarter = R"(, sector = 90 }
[[support]]
where = "set:x-min"
fix = ["x"]
[[support]]
where = "set:y-min"
fix = ["y"])";
  EXPECT_TRUE(told(turn, quarter));
  EXPECT_FALSE(told("", quarter));
  EXPECT_FALSE(told(turn, " }"));
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
