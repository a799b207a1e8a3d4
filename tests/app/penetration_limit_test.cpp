// max_penetration in a case file, from the program's side: the history obeys it, or the run stops
// and says so.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace billet::test::penetration_limit_test {

namespace {

class PenetrationLimitOfACase : public testing::Test {
protected:
  /// Runs the tiny upsetting with a penalty so soft that it shows, and these contact keys.
  [[nodiscard]] Outcome run(const std::string& name, const std::string& contact) const {
    write_text(folder_.path() / (name + ".toml"),
               edited(upsetting, {{"[time]", "[contact]\nform = \"compatible\"\npenalty = 1\n" +
                                                 contact + "\n[time]"}}));
    return billet({"run", name + ".toml", "--quiet", "-o", name}, folder_.path());
  }
  [[nodiscard]] double deepest(const std::string& name) const {
    const auto all = read_table(folder_.path() / name / "history.csv").values("max_penetration");
    return all.empty() ? 0.0 : *std::max_element(all.begin(), all.end());
  }
  [[nodiscard]] nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(whole_file(folder_.path() / name / "summary.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(PenetrationLimitOfACase, holds_in_the_history_by_both_methods) {
  ASSERT_EQ(run("free", "").status, 0);
  EXPECT_GT(deepest("free"), 1e-3);
  EXPECT_EQ(summary("free").at("penetration").at("penalty_raised_by"), 1.0);
  for (const std::string method : {"penalty", "augmented"}) {
    const Outcome outcome =
        run(method, "method = \"" + method + "\"\nmax_penetration = \"0.2 um\"");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_LE(deepest(method), 2e-4);
    const nlohmann::json penetration = summary(method).at("penetration");
    EXPECT_EQ(penetration.at("largest"), deepest(method));
    EXPECT_LE(penetration.at("last_sampled"), penetration.at("last"));
    EXPECT_LE(penetration.at("last_at_contact_points"), penetration.at("last_sampled"));
    EXPECT_GE(summary(method).at("seconds").at("certificate"), 0.0);
  }
}

TEST_F(PenetrationLimitOfACase, stops_the_run_where_it_cannot_be_met) {
  const Outcome outcome = run("impossible", "max_penetration = 1e-12");
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  const std::string reason = summary("impossible").at("failure").at("reason");
  EXPECT_NE(reason.find("max_penetration = 1e-12"), std::string::npos) << reason;
  EXPECT_NE(reason.find("inside tool 'punch' near ("), std::string::npos) << reason;
  const std::string text =
      whole_file(folder_.path() / "impossible" / "failure" / "post_mortem.txt");
  EXPECT_NE(text.find("deepest in a tool near ("), std::string::npos) << text;
}

} // namespace
} // namespace billet::test::penetration_limit_test
