#include "geometry/base/error.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "study/quantity.h"

namespace billet::study::quantity_test {
namespace {

using Take = Quantity::Take;

class QuantityOfRun : public testing::Test {
protected:
  QuantityOfRun() {
    (void)folder_.file("history.csv", "time,height,punch.force_y\n"
                                      "1,10,-100\n2,8,-300\n4,4,-200\n");
    (void)folder_.file("summary.json", R"({"iterations": 7, "energy": {"plastic_work": 2.5},
                                           "tools": {"punch": {"force": [0, 3, 0]}}})");
  }
  [[nodiscard]] double value(const Quantity& quantity) const {
    return evaluate(quantity, Results(folder_.path()), {{"force", 3.0}});
  }
  test::TemporaryFolder folder_;
};

TEST_F(QuantityOfRun, IsTakenWhereTheRunEnds) {
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y"}), 200.0);
}

TEST_F(QuantityOfRun, IsTakenAtATimeOrAtAnyOtherValue) {
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::at, .at = 3.0}),
                   250.0);
  EXPECT_DOUBLE_EQ(
      value({.name = "f", .of = "-punch.force_y", .over = "height", .take = Take::at, .at = 9.0}),
      200.0);
  EXPECT_DOUBLE_EQ(
      value({.name = "f", .of = "time", .over = "1 - height/10", .take = Take::at, .at = 0.2}),
      2.0);
  EXPECT_THROW((void)value({.name = "f", .of = "time", .take = Take::at, .at = 5.0}), Error);
  EXPECT_THROW((void)value({.name = "f", .of = "time", .take = Take::at, .at = 0.5}), Error);
}

TEST_F(QuantityOfRun, IsTheLargestTheSmallestOrTheMeanOfAWindow) {
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::largest}), 300.0);
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::smallest}), 100.0);
  // (1 * 200 + 2 * 250) / 3
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::mean}), 700.0 / 3.0);
  // from 3 on: between 250 and 200
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::mean, .from = 3.0}),
                   225.0);
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "-punch.force_y", .take = Take::largest, .from = 3.0}),
                   250.0);
  EXPECT_THROW((void)value({.name = "f", .of = "time", .take = Take::mean, .from = 8.0, .to = 9.0}),
               Error);
}

TEST_F(QuantityOfRun, HasTheSameMeanOverWhatFallsAsOverWhatRises) {
  // height 9 to 6: 200 to 300 within 1, 300 to 250 within 2
  const double mean = (1.0 * 250.0 + 2.0 * 275.0) / 3.0;
  EXPECT_DOUBLE_EQ(value({.name = "f",
                          .of = "-punch.force_y",
                          .over = "height",
                          .take = Take::mean,
                          .from = 6.0,
                          .to = 9.0}),
                   mean);
  EXPECT_DOUBLE_EQ(value({.name = "f",
                          .of = "-punch.force_y",
                          .over = "10 - height",
                          .take = Take::mean,
                          .from = 1.0,
                          .to = 4.0}),
                   mean);
}

TEST_F(QuantityOfRun, MayBeOfTheSummaryOrOfQuantitiesBefore) {
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "summary.iterations + summary.energy.plastic_work"}),
                   9.5);
  EXPECT_DOUBLE_EQ(value({.name = "f", .of = "summary.tools.punch.force.1"}), 3.0);
  EXPECT_DOUBLE_EQ(value({.name = "f", .expression = "2 * force"}), 6.0);
  EXPECT_THROW((void)value({.name = "f", .expression = "forces"}), Error);
}

TEST(CurveAt, GoesStraightBetweenPoints) {
  const double x[] = {1.0, 2.0, 4.0}, y[] = {0.0, 10.0, 0.0};
  EXPECT_DOUBLE_EQ(*curve_at(x, y, 3.0), 5.0);
  EXPECT_DOUBLE_EQ(*curve_at(x, y, 4.0), 0.0);
  EXPECT_FALSE(curve_at(x, y, 0.5));
  EXPECT_FALSE(curve_at(x, y, 4.5));
}

} // namespace
} // namespace billet::study::quantity_test
