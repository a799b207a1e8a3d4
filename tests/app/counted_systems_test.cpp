// Every linear system of a run belongs to a figure of its summary.

#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <string>

namespace billet::test::counted_systems_test {

namespace {

/// Without increments of its own: those of the program are refused now and then.
const std::string plain =
    edited(upsetting,
           {{"increments = { first = 0.02, max = 0.02 }\n", ""}, {"end = 0.1", "end = 1"}});

class CountedSystems : public testing::Test {
protected:
  /// Runs a case and compares the sum of the figures with what the linear solver counts.
  nlohmann::json run(const std::string& text, int status = 0) const {
    write_text(folder_.path() / "tiny.toml", text);
    const Outcome outcome = billet({"run", "tiny.toml", "--quiet", "-o", "out"}, folder_.path());
    EXPECT_EQ(outcome.status, status) << outcome.err;
    nlohmann::json summary =
        nlohmann::json::parse(whole_file(folder_.path() / "out" / "summary.json"));
    const int sum = summary.at("iterations").get<int>() +
                    summary.at("iterations_of_failed_tries").get<int>() +
                    summary.at("iterations_on_new_meshes").get<int>();
    EXPECT_EQ(sum, summary.at("linear_solver").at("systems")) << text;
    EXPECT_GT(sum, 0);
    return summary;
  }

  TemporaryFolder folder_;
};

TEST_F(CountedSystems, with_new_meshes) {
  const nlohmann::json summary =
      run(edited(plain, {{"[time]", "[remesh]\nwhen = { interval = 0.3 }\n\n[time]"}}));
  EXPECT_GT(summary.at("remeshings").at("number"), 1);
  EXPECT_GT(summary.at("iterations_on_new_meshes"), 0);
}

TEST_F(CountedSystems, with_a_limit_of_penetration) {
  for (const std::string method : {"penalty", "augmented"}) {
    const nlohmann::json summary = run(
        edited(upsetting, {{"[time]", "[contact]\nform = \"compatible\"\npenalty = 1\nmethod = \"" +
                                          method + "\"\nmax_penetration = \"0.2 um\"\n\n[time]"}}));
    EXPECT_EQ(summary.at("iterations_on_new_meshes"), 0);
  }
  run(edited(upsetting, {{"[time]", "[contact]\nmax_penetration = 1e-12\n\n[time]"}}), 5);
}

TEST_F(CountedSystems, with_refused_increments) {
  const nlohmann::json summary =
      run(edited(plain, {{"end = 1\n", "end = 4\nincrements = { first = 4, max = 4 }\n"}}));
  EXPECT_GT(summary.at("cutbacks"), 0);
  EXPECT_GT(summary.at("iterations_of_failed_tries"), 0);
}

TEST_F(CountedSystems, with_a_tool_under_a_load) {
  // Each system has another right-hand side there.
  run(edited(plain, {{"motion   = { velocity = [0, -1] }",
                      "motion   = { force = { direction = [0, -1], value = [[0, 0], [1, 3e4]] } }\n"
                      "touch    = true"}}));
}

TEST_F(CountedSystems, with_a_part_that_only_tools_hold) {
  run(edited(plain, {{"[[support]]\nwhere = \"y = 0\"\nfix   = [\"y\"]",
                      "[[tool]]\nname = \"anvil\"\n"
                      "surface = { plane = { point = [0, 0], normal = [0, 1] } }"}}));
}

} // namespace

} // namespace billet::test::counted_systems_test
