#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "study/convergence.h"
#include "study/study_json.h"
#include "study/trade.h"

namespace billet::study::trade_test {
namespace {

Level level(const std::string& label, double size) { return {label, {{"k", label}}, size}; }

/// Error falls with the mesh's size, cost grows; the problem's figure is 10 and 20.
Study two_problems() {
  Study study;
  study.axes = {
      {"problem", {{"a", {{"p", "1"}}}, {"b", {{"p", "2"}}}}},
      {"mesh", {level("coarse", 8), level("middle", 4), level("fine", 2), level("finest", 1)}}};
  study.quantities = {{.name = "force", .of = "f"}};
  study.trade = TradeSettings{.reference = {{"mesh", "finest"}}, .within = 0.05};
  study.convergence = ConvergenceSettings{.axes = {"mesh"}};
  return study;
}

std::vector<OutcomeRow> outcomes(const Study& study) {
  std::vector<OutcomeRow> rows;
  for (const Row& row : rows_of(study)) {
    const double exact = row.labels[0] == "a" ? 10.0 : 20.0;
    double size = 0.0;
    for (const Level& each : study.axes[1].levels)
      if (each.label == row.labels[1])
        size = *each.size;
    rows.push_back(
        {row, "", EndedRun{}, {exact * (1.0 + 0.02 * size)}, {.processor_time = 8.0 / size}, true});
  }
  return rows;
}

TEST(Trade, MeasuresErrorsAgainstTheReferenceOfTheSameProblem) {
  const Study study = two_problems();
  const Trade trade = trade_of(study, outcomes(study));
  ASSERT_EQ(trade.settings.size(), 4U);
  EXPECT_EQ(trade.axes, std::vector<std::string>{"mesh"});
  EXPECT_NEAR(trade.settings[0].error, 0.14 / 1.02, 1e-12);
  EXPECT_NEAR(trade.settings[2].error, 0.02 / 1.02, 1e-12);
  EXPECT_TRUE(trade.settings[3].is_reference);
  EXPECT_EQ(trade.settings[3].error, 0.0);
  EXPECT_DOUBLE_EQ(trade.settings[1].cost, 2.0);
  EXPECT_EQ(trade.errors.size(), 8U);
}

TEST(Trade, MeasuresWhatGoesThroughZeroByItsScale) {
  Study study = two_problems();
  study.quantities[0].scale = 4.0;
  const Trade trade = trade_of(study, outcomes(study));
  EXPECT_NEAR(trade.errors[0], 10.0 * 0.14 / 4.0, 1e-12);
}

TEST(Trade, OfAReferenceOfZeroHasNoErrorsAndSaysSo) {
  const Study study = two_problems();
  std::vector<OutcomeRow> rows = outcomes(study);
  for (OutcomeRow& row : rows)
    row.values[0] -= row.row.labels[0] == "a" ? 10.2 : 20.4; // the finest of each
  for (OutcomeRow& row : rows)
    row.values[0] = std::abs(row.values[0]) < 1e-12 ? 0.0 : row.values[0];
  const Trade trade = trade_of(study, rows);
  EXPECT_TRUE(std::isnan(trade.errors[0]));
  EXPECT_EQ(trade.zero_in_reference, std::vector<std::string>{"force"});
  EXPECT_FALSE(trade.cheapest_within);
}

TEST(Trade, NamesTheFrontAndTheCheapestThatIsGoodEnough) {
  const Study study = two_problems();
  std::vector<OutcomeRow> rows = outcomes(study);
  rows[1].cost.processor_time = rows[5].cost.processor_time = 9.0; // dearer than `fine`, and worse
  const Trade trade = trade_of(study, rows);
  EXPECT_EQ(trade.front, (std::vector<std::size_t>{0, 2}));
  EXPECT_FALSE(trade.settings[1].on_front);
  ASSERT_TRUE(trade.cheapest_within);
  EXPECT_EQ(*trade.cheapest_within, 2U);
  const std::string text = in_words(study, {trade, {}});
  EXPECT_NE(text.find("k = fine"), std::string::npos) << text;
}

TEST(Trade, TellsErrorAndCostOfEachProblem) {
  const Study study = two_problems();
  std::vector<OutcomeRow> rows = outcomes(study);
  rows[4].values.clear(); // coarse, of problem b
  rows[4].complete = false;
  rows[4].end = EndedRun{5, "no"};
  const Trade trade = trade_of(study, rows);
  ASSERT_EQ(trade.problems.size(), 2U);
  EXPECT_EQ(trade.problem_axes, std::vector<std::string>{"problem"});
  EXPECT_EQ(trade.problems[1].labels, std::vector<std::string>{"b"});
  EXPECT_NEAR(trade.problems[0].errors[0], 0.14 / 1.02, 1e-12);
  EXPECT_TRUE(std::isnan(trade.problems[1].errors[0]));
  EXPECT_DOUBLE_EQ(trade.problems[1].costs[2], 4.0);
  const std::string text = in_words(study, {trade, {}});
  EXPECT_NE(text.find("| problem | coarse | middle | fine | finest |"), std::string::npos) << text;
  EXPECT_NE(text.find("| b | failed, 1 | 5.88 %, 2 |"), std::string::npos) << text;
}

TEST(Trade, KneesWhereErrorsStopToFall) {
  Study study = two_problems();
  std::vector<OutcomeRow> rows = outcomes(study);
  // Of cost 1, 2, 4 the errors are large, small and hardly smaller.
  const double errors[] = {0.5, 0.011, 0.01, 0.0};
  for (std::size_t r = 0; r < rows.size(); ++r)
    rows[r].values[0] = (r < 4 ? 10.0 : 20.0) * (1.0 + errors[r % 4]);
  const Trade trade = trade_of(study, rows);
  ASSERT_TRUE(trade.knee);
  EXPECT_EQ(*trade.knee, 1U);
}

TEST(Trade, ASettingWithARunThatFailedHasNoError) {
  const Study study = two_problems();
  std::vector<OutcomeRow> rows = outcomes(study);
  rows[2].values.clear();
  rows[2].complete = false;
  rows[2].end = EndedRun{5, "no"};
  const Trade trade = trade_of(study, rows);
  EXPECT_TRUE(std::isinf(trade.settings[2].error));
  EXPECT_TRUE(std::isnan(trade.errors[2]));
  EXPECT_FALSE(trade.settings[2].on_front);
}

TEST(Convergence, ExtrapolatesEveryProblem) {
  const Study study = two_problems();
  const std::vector<Convergence> found = convergence_of(study, outcomes(study));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].problem, std::vector<std::string>{"a"});
  EXPECT_NEAR(found[0].limit, 10.0, 1e-6);
  EXPECT_NEAR(found[1].limit, 20.0, 1e-6);
  EXPECT_NEAR(found[1].along[0].extrapolation.order, 1.0, 1e-4);
  EXPECT_NEAR(found[0].uncertainty, 1.25 * 0.2, 1e-4);
}

} // namespace
} // namespace billet::study::trade_test
