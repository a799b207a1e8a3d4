// The table of a verification: rows, failures, problems that cannot be run, names.

#include "geometry/base/error.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/verify/report.h"
#include "study/verify/verify.h"

namespace billet::study::report_test {
namespace {

std::vector<Figure> good(const CaseBench&) {
  return {relative("force", "N", 100.4, 100.0, 0.01), absolute("gap", "mm", 0.0, 0.0, 1e-9)};
}
std::vector<Figure> bad(const CaseBench&) { return {relative("a < b | c", "-", 2.0, 1.0, 0.1)}; }
std::vector<Figure> broken(const CaseBench&) { throw std::runtime_error("it does\nnot run"); }
std::vector<Figure> nothing(const CaseBench&) { return {}; }

constexpr std::array sample{
    Problem{"good", "all is well", "Hooke 1678", &good},
    Problem{"bad", "a figure is off", "nobody", &bad},
    Problem{"broken", "it cannot be run", "nobody", &broken},
    Problem{"nothing", "it says nothing", "nobody", &nothing},
};

std::vector<ProblemOutcome> outcomes_of(const std::vector<std::string>& names) {
  const test::TemporaryFolder folder;
  return verify(chosen_problems(sample, names), CaseBench(folder.path()), {});
}

TEST(VerifyReport, a_row_has_figure_reference_deviation_tolerance_and_source) {
  const std::string rows = markdown_rows(outcomes_of({"good"})[0]);
  EXPECT_NE(rows.find("| good | force | 100.4 N | 100 N | 0.4 % | ±1 % | ok | Hooke 1678 |"),
            std::string::npos)
      << rows;
  EXPECT_NE(rows.find("| good | gap | 0 mm | 0 mm | 0 mm | ±1e-09 mm | ok |"), std::string::npos)
      << rows;
}

TEST(VerifyReport, a_figure_that_is_off_is_a_failure) {
  const auto outcomes = outcomes_of({"bad"});
  EXPECT_FALSE(outcomes[0].passed());
  EXPECT_EQ(count(outcomes).failed, 1);
  EXPECT_NE(
      markdown_rows(outcomes[0]).find("| bad | a < b \\| c | 2 | 1 | 100 % | ±10 % | FAILED |"),
      std::string::npos)
      << markdown_rows(outcomes[0]);
  EXPECT_NE(html_text(outcomes, "1.2").find("<td>a &lt; b | c</td>"), std::string::npos);
  EXPECT_NE(html_text(outcomes, "1.2").find("<tr class=\"failed\">"), std::string::npos);
}

TEST(VerifyReport, what_cannot_be_run_is_a_failure_and_the_others_go_on) {
  const auto outcomes = outcomes_of({});
  ASSERT_EQ(outcomes.size(), sample.size());
  EXPECT_TRUE(outcomes[0].passed());
  EXPECT_NE(markdown_rows(outcomes[2]).find("cannot be run: it does not run"), std::string::npos);
  EXPECT_FALSE(outcomes[3].passed());
  EXPECT_EQ(count(outcomes).figures, 5);
  EXPECT_EQ(count(outcomes).failed, 3);
  const std::string text = markdown_text(outcomes, "1.2");
  EXPECT_TRUE(text.starts_with("# Verification of billet 1.2\n")) << text;
  EXPECT_NE(text.find("5 figures of 4 problems, 3 of them FAILED"), std::string::npos) << text;
}

TEST(VerifyReport, stops_between_problems_when_it_is_asked_to) {
  const test::TemporaryFolder folder;
  int asked = 0;
  const auto outcomes = verify(chosen_problems(sample, {}), CaseBench(folder.path()),
                               {[&] { return ++asked > 1; }, {}});
  EXPECT_EQ(outcomes.size(), 1U);
}

TEST(VerifyReport, an_unknown_name_is_refused_with_the_one_that_is_meant) {
  try {
    static_cast<void>(chosen_problems(sample, std::vector<std::string>{"brocken"}));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    EXPECT_NE(std::string(error.what()).find("broken"), std::string::npos) << error.what();
  }
}

TEST(VerifyReport, the_list_names_every_problem_once_with_its_source) {
  const std::string list = list_text(all_problems());
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), std::ssize(all_problems()));
  for (const Problem& problem : all_problems()) {
    EXPECT_NE(list.find(problem.name), std::string::npos);
    EXPECT_FALSE(problem.source.empty()) << problem.name;
    EXPECT_EQ(std::count_if(all_problems().begin(), all_problems().end(),
                            [&](const Problem& other) { return other.name == problem.name; }),
              1)
        << problem.name;
  }
}

} // namespace
} // namespace billet::study::report_test
