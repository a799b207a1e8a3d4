// Coefficients found back from charts whose truth is known.

#include "geometry/base/error.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "study/chart_model.h"
#include "study/identify.h"

namespace billet::study::identify_test {
namespace {

using Curve = std::function<double(double parameter, double x)>;

/// As of barrelling: it grows with friction, less and less, and with the reduction.
double saturating(double m, double x) { return 1.0 + 0.25 * x * (1.0 - std::exp(-4.0 * m)); }
/// Another law's: the more, the farther the test goes.
double late(double mu, double x) { return 1.0 + 0.6 * mu * x * x; }
/// Hardly of the parameter.
double blunt(double m, double x) { return 100.0 * (1.0 + x) * (1.0 + 0.05 * m); }

ChartedLaw charted(const std::string& name,
                   const std::string& parameter,
                   double most,
                   const std::vector<Curve>& curves,
                   const std::vector<double>& stations) {
  ChartedLaw law{name, {{parameter, {parameter}, {}}}, {}};
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i)
    law.parameters[0].values.push_back(most * i / steps);
  for (std::size_t q = 0; q < curves.size(); ++q) {
    ChartedQuantity quantity{"q" + std::to_string(q), {}, {}, {}};
    for (const double value : law.parameters[0].values) {
      quantity.values.emplace_back();
      for (const double x : stations)
        quantity.values.back().push_back(curves[q](value, x));
      quantity.model_error.emplace_back(stations.size(), 0.0);
    }
    law.quantities.push_back(std::move(quantity));
  }
  return law;
}

Chart two_laws() {
  Chart chart{"", "x", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {}, {}};
  chart.laws = {charted("saturating", "m", 0.5, {saturating}, chart.stations),
                charted("late", "mu", 0.5, {late}, chart.stations)};
  return chart;
}

TEST(MonotoneCubic, GoesThroughItsPointsWithoutOvershoot) {
  const std::vector<double> x{0.0, 1.0, 2.0, 4.0}, y{0.0, 1.0, 1.0, 3.0};
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_DOUBLE_EQ(monotone_cubic(x, y, x[i]), y[i]);
  for (double at = 1.0; at <= 2.0; at += 0.1)
    EXPECT_NEAR(monotone_cubic(x, y, at), 1.0, 1e-14);
  const std::vector<double> parabola{0.0, 1.0, 4.0, 16.0};
  EXPECT_NEAR(monotone_cubic(x, parabola, 3.0), 9.0, 0.3);
}

TEST(Identify, FindsTheParameterAndTheIntervalOfOneValue) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  const double truth = 0.2, x = 0.4, uncertainty = 0.004;
  const Identification found = identify(chart, {{0, x, saturating(truth, x), uncertainty / 1.96}});
  const double slope = x * std::exp(-4.0 * truth); // of 0.25 (1 - exp(-4 m))
  const Found& m = found.laws[0].parameters[0];
  EXPECT_NEAR(m.value, truth, 2e-3);
  EXPECT_NEAR(0.5 * (m.high - m.low), uncertainty / slope, 0.05 * uncertainty / slope);
  EXPECT_TRUE(found.warnings.empty());
}

TEST(Identify, CountsWhatTheModelAndTheFlowCurveLeave) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  const auto width = [&] {
    const Found m = identify(chart, {{0, 0.4, saturating(0.2, 0.4), 0.002}}).laws[0].parameters[0];
    return m.high - m.low;
  };
  const double before = width();
  for (std::vector<double>& row : chart.laws[0].quantities[0].model_error)
    row.assign(row.size(), 1.96 * 0.002);
  EXPECT_NEAR(width(), std::sqrt(2.0) * before, 0.03 * before);
  chart.uncertain = {"n"};
  chart.laws[0].quantities[0].change = {
      std::vector<std::vector<double>>(chart.laws[0].parameters[0].values.size(),
                                       std::vector<double>(chart.stations.size(), 0.002))};
  EXPECT_NEAR(width(), std::sqrt(3.0) * before, 0.04 * before);
}

TEST(Identify, GoesOnWhereRunsOfWhatIsUncertainFailed) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  const std::size_t n = chart.laws[0].parameters[0].values.size();
  chart.uncertain = {"n"};
  chart.laws[0].quantities[0].change = {
      std::vector<std::vector<double>>(n, std::vector<double>(chart.stations.size(), 0.002))};
  const std::vector<Measured> data{{0, 0.4, saturating(0.2, 0.4), 0.002}};
  const Identification all = identify(chart, data);
  EXPECT_TRUE(all.warnings.empty());
  std::vector<std::vector<double>>& change = chart.laws[0].quantities[0].change[0];
  change[1].assign(chart.stations.size(), std::nan(""));
  const Identification some = identify(chart, data);
  ASSERT_EQ(some.warnings.size(), 1U);
  EXPECT_NE(some.warnings[0].find("what n changes is not known"), std::string::npos);
  EXPECT_DOUBLE_EQ(some.laws[0].parameters[0].low, all.laws[0].parameters[0].low);
  for (std::vector<double>& at : change)
    at.assign(chart.stations.size(), std::nan(""));
  const Found none = identify(chart, data).laws[0].parameters[0];
  EXPECT_LT(none.high - none.low, all.laws[0].parameters[0].high - all.laws[0].parameters[0].low);
}

/// However small the uncertainty of what was measured is, that of the chart stays.
TEST(Identify, BearsTinyUncertaintiesAndRefusesWhatIsNoNumber) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  for (std::vector<double>& row : chart.laws[0].quantities[0].model_error)
    row.assign(row.size(), 0.004);
  const Found with = identify(chart, {{0, 0.4, saturating(0.2, 0.4), 1e-6}}).laws[0].parameters[0];
  for (const double tiny : {1e-9, 1e-12, 1e-100}) {
    const Found m = identify(chart, {{0, 0.4, saturating(0.2, 0.4), tiny}}).laws[0].parameters[0];
    EXPECT_NEAR(m.value, with.value, 1e-4) << tiny;
    EXPECT_NEAR(m.high - m.low, with.high - with.low, 1e-4) << tiny;
  }
  EXPECT_THROW((void)identify(chart, {{0, 0.4, 1e300, 1.0}}), Error);
}

TEST(Identify, WarnsOfWhatLiesOutsideOfAllCurves) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  const Identification found = identify(chart, {{0, 0.4, 5.0, 0.01}});
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings[0].find("outside of all curves"), std::string::npos);
  EXPECT_FALSE(found.laws[0].p); // nothing is left to tell by
  EXPECT_EQ(in_words(found).find("p ="), std::string::npos);
}

TEST(Identify, WarnsOfAChartOfTwoValues) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  ChartedLaw& law = chart.laws[0];
  law.parameters[0].values.resize(2);
  law.quantities[0].values.resize(2);
  law.quantities[0].model_error.resize(2);
  const double between = 0.5 * (law.quantities[0].values[0][1] + law.quantities[0].values[1][1]);
  const Identification found = identify(chart, {{0, chart.stations[1], between, 1e-4}});
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings[0].find("with two values of m"), std::string::npos);
}

TEST(Identify, TakesManyMeasurements) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  std::vector<Measured> data;
  constexpr int many = 2000; // a matrix of so many rows would take minutes
  for (int i = 0; i < many; ++i)
    data.push_back({0, 0.4, saturating(0.2, 0.4) + (i % 2 == 0 ? 0.01 : -0.01), 0.01});
  const Found m = identify(chart, data).laws[0].parameters[0];
  EXPECT_NEAR(m.value, 0.2, 2e-3);
  EXPECT_LT(m.low, 0.2);
  EXPECT_GT(m.high, 0.2);
}

/// Where a chart has few values of its parameter, its curve between them is off by more than what
/// was measured.
TEST(Identify, CountsWhatTheSpacingOfTheChartLeaves) {
  Chart chart{"", "x", {0.2, 0.4, 0.6}, {}, {}};
  ChartedLaw law{"law", {{"m", {"m"}, {0.0, 0.1, 0.2, 0.35, 0.5, 0.8}}}, {{"q0", {}, {}, {}}}};
  const auto curved = [](double m, double x) { return x * std::tanh(4.0 * m); };
  for (const double m : law.parameters[0].values) {
    std::vector<double>& along = law.quantities[0].values.emplace_back();
    for (const double x : chart.stations)
      along.push_back(curved(m, x));
    law.quantities[0].model_error.emplace_back(chart.stations.size(), 0.0);
  }
  chart.laws = {law};
  constexpr double tiny = 1e-5;
  int held = 0, tests = 0;
  for (double truth = 0.03; truth < 0.6; truth += 0.01) {
    std::vector<Measured> data;
    for (const double x : chart.stations)
      data.push_back({0, x, curved(truth, x), tiny});
    const Found m = identify(chart, data).laws[0].parameters[0];
    held += m.low <= truth && truth <= m.high ? 1 : 0;
    ++tests;
    EXPECT_LT(m.high - m.low, 0.2) << truth;
  }
  std::printf("the interval holds the truth in %d of %d\n", held, tests);
  EXPECT_GE(held, 0.95 * tests);
}

TEST(Identify, OfValuesWithoutUncertaintiesTakesThemFromTheScatter) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  std::vector<Measured> data;
  double sign = 1.0;
  for (const double x : chart.stations)
    data.push_back({0, x, saturating(0.2, x) + 1e-3 * (sign = -sign), 0.0});
  const Found m = identify(chart, data).laws[0].parameters[0];
  EXPECT_LT(m.low, 0.2);
  EXPECT_GT(m.high, 0.2);
  EXPECT_LT(m.high - m.low, 0.03);
  EXPECT_THROW((void)identify(chart, {data[0]}), Error);
}

TEST(Identify, WarnsWhereDataCannotTell) {
  Chart chart{"", "x", {0.1, 0.5}, {}, {}};
  chart.laws = {charted("law", "m", 0.5, {blunt}, chart.stations)};
  const Identification found = identify(chart, {{0, 0.5, blunt(0.2, 0.5), 1.5}});
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings[0].find("1 % of q0 changes m by at least 0.2"), std::string::npos)
      << found.warnings[0];
  EXPECT_TRUE(found.laws[0].parameters[0].from_end);
  EXPECT_TRUE(found.laws[0].parameters[0].to_end);
}

TEST(Identify, RefusesPlacesOutsideOfTheChart) {
  EXPECT_THROW((void)identify(two_laws(), {{0, 0.7, 1.0, 0.1}}), Error);
  EXPECT_THROW((void)identify(two_laws(), {}), Error);
}

TEST(Identify, LeavesRunsOutThatDidNotGetThere) {
  Chart chart = two_laws();
  chart.laws.pop_back();
  for (std::size_t s = 3; s < chart.stations.size(); ++s)
    chart.laws[0].quantities[0].values.back()[s] = std::nan("");
  const Identification found = identify(chart, {{0, 0.5, saturating(0.2, 0.5), 0.002}});
  EXPECT_NEAR(found.laws[0].parameters[0].value, 0.2, 2e-3);
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_NE(found.warnings[0].find("m = 0.5 is left out"), std::string::npos) << found.warnings[0];
  for (std::vector<double>& values : chart.laws[0].quantities[0].values)
    values.back() = std::nan("");
  EXPECT_THROW((void)identify(chart, {{0, 0.6, 1.0, 0.002}}), Error);
}

TEST(Identify, FindsTwoParameters) {
  Chart chart{"", "x", {0.1, 0.3, 0.5, 0.7}, {}, {}};
  ChartedLaw law{"two", {{"a", {"a"}, {0.0, 0.5, 1.0}}, {"b", {"b"}, {0.0, 0.5, 1.0}}}, {}};
  const auto at = [](double a, double b, double x) { return a * x + b * x * x; };
  ChartedQuantity quantity{"q0", {}, {}, {}};
  for (const double a : {0.0, 0.5, 1.0})
    for (const double b : {0.0, 0.5, 1.0}) {
      quantity.values.emplace_back();
      for (const double x : chart.stations)
        quantity.values.back().push_back(at(a, b, x));
      quantity.model_error.emplace_back(chart.stations.size(), 0.0);
    }
  law.quantities = {quantity};
  chart.laws = {law};
  std::vector<Measured> data;
  for (const double x : chart.stations)
    data.push_back({0, x, at(0.3, 0.6, x), 1e-3});
  const Identification found = identify(chart, data);
  EXPECT_NEAR(found.laws[0].parameters[0].value, 0.3, 0.01);
  EXPECT_NEAR(found.laws[0].parameters[1].value, 0.6, 0.02);
  EXPECT_LT(found.laws[0].parameters[0].low, 0.3);
  EXPECT_GT(found.laws[0].parameters[0].high, 0.3);
}

/// 100 tests with random truth, law and noise: how often the interval holds the truth, and whether
/// the wrong law is ever preferred.
TEST(Identify, HoldsTheTruthInNinetyFiveOfAHundredTests) {
  const Chart chart = two_laws();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> parameter(0.03, 0.45), noise(0.0005, 0.01);
  std::normal_distribution<double> normal;
  constexpr int tests = 100;
  int held = 0, wrong = 0, told = 0;
  for (int i = 0; i < tests; ++i) {
    const std::size_t law = random() % 2;
    const double truth = parameter(random), sigma = noise(random);
    std::vector<Measured> data;
    for (const double x : chart.stations)
      data.push_back(
          {0, x, (law == 0 ? saturating : late)(truth, x) + sigma * normal(random), sigma});
    const Identification found = identify(chart, data);
    const Found& interval = found.laws[law].parameters[0];
    held += interval.low <= truth && truth <= interval.high ? 1 : 0;
    wrong += found.comparisons[law] == Comparison::told_apart ? 1 : 0;
    told += found.comparisons[1 - law] == Comparison::told_apart ? 1 : 0;
  }
  std::printf("the interval holds the truth in %d of %d, the law is told in %d, wrong in %d\n",
              held, tests, told, wrong);
  EXPECT_GE(held, 93);
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(told, 30);
}

TEST(ChartFile, IsReadBackAndRefusedWherePartsAreMissing) {
  const test::TemporaryFolder folder;
  write_chart(two_laws(), folder.path());
  EXPECT_EQ(read_chart(folder.path() / "chart.json").laws[1].quantities[0].values,
            two_laws().laws[1].quantities[0].values);
  using nlohmann::json;
  std::ifstream in(folder.path() / "chart.json");
  const json sound = json::parse(in);
  const auto spoilt = [&](const std::function<void(json&)>& spoil) {
    json chart = sound;
    spoil(chart);
    EXPECT_THROW((void)read_chart(folder.file("chart.json", chart.dump())), Error) << chart.dump();
  };
  const auto last_of = [](json& list) { list.erase(list.size() - 1); };
  spoilt([&](json& chart) { last_of(chart["laws"][0]["quantities"][0]["values"]); });
  spoilt([&](json& chart) { last_of(chart["laws"][0]["quantities"][0]["model_error"][2]); });
  spoilt([](json& chart) { chart["laws"][1]["parameters"][0]["values"][0] = 9.0; });
  spoilt([](json& chart) { chart["laws"][1]["quantities"][0]["name"] = "another"; });
  spoilt([](json& chart) { chart["uncertain"] = {"n"}; });
  spoilt([&](json& chart) { last_of(chart["stations"]); });
  for (const char* const text : {"", "7", "{}", "[1]", R"({"title": "", "x": "x", "laws": 3})"})
    EXPECT_THROW((void)read_chart(folder.file("chart.json", text)), Error) << text;
}

class MeasurementFile : public testing::Test {
protected:
  [[nodiscard]] std::vector<Measured> read(const std::string& text) const {
    return read_measurements(folder_.file("m.csv", text), two_laws());
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(MeasurementFile, HasUncertaintiesOfTwoKinds) {
  EXPECT_NEAR(read("x,q0,q0_uncertainty\n0.4,1.04,0.00196\n")[0].standard, 0.001, 1e-12);
  EXPECT_NEAR(read("# by hand\nx, q0, q0_standard\n0.4, 1.04, 0.001\n")[0].standard, 0.001, 1e-12);
  EXPECT_EQ(read("x,q0\n0.4,1.04\n0.5,\n").size(), 1U);
}

TEST_F(MeasurementFile, IsRefusedWithWhatIsWrong) {
  EXPECT_NE(refusal("y,q0\n1,1\n").find("no column 'x'"), std::string::npos);
  EXPECT_NE(refusal("x,q1\n1,1\n").find("did you mean 'q0'?"), std::string::npos);
  EXPECT_NE(refusal("x,q0\n0.4,much\n").find("row 1"), std::string::npos);
  EXPECT_NE(refusal("x,q0,q0_standard\n0.4,1,0\n").find("above 0"), std::string::npos);
}

} // namespace
} // namespace billet::study::identify_test
