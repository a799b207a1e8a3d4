#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "study/extrapolation.h"

namespace billet::study::extrapolation_test {
namespace {

const std::vector<double> sizes{4.0, 2.0, 1.0};

std::vector<double> power(double limit, double alpha, double p, const std::vector<double>& h) {
  std::vector<double> values;
  for (const double size : h)
    values.push_back(limit + alpha * std::pow(size, p));
  return values;
}

TEST(Extrapolation, FindsLimitAndOrderOfAPowerLaw) {
  for (const double p : {0.7, 1.0, 1.5, 2.0}) {
    const Extrapolation found = extrapolate(sizes, power(10.0, -0.3, p, sizes));
    EXPECT_EQ(found.range, Extrapolation::Range::asymptotic) << p;
    EXPECT_NEAR(found.order, p, 1e-4);
    EXPECT_NEAR(found.limit, 10.0, 1e-5);
    EXPECT_NEAR(found.uncertainty[2], 1.25 * 0.3, 1e-4);
  }
}

TEST(Extrapolation, OfFourSizesIsTheBestFitThroughScatter) {
  const std::vector<double> h{4.0, 2.8, 2.0, 1.4, 1.0};
  std::vector<double> values = power(10.0, 0.2, 1.0, h);
  const double noise[] = {0.01, -0.012, 0.008, -0.01, 0.006};
  for (std::size_t i = 0; i < h.size(); ++i)
    values[i] += noise[i];
  const Extrapolation found = extrapolate(h, values);
  EXPECT_EQ(found.range, Extrapolation::Range::asymptotic);
  EXPECT_NEAR(found.order, 1.0, 0.3);
  EXPECT_LT(std::abs(found.limit - 10.0), found.uncertainty.back());
  EXPECT_GT(found.uncertainty.back(), 1.25 * std::abs(values.back() - found.limit) - 0.02);
}

TEST(Extrapolation, SaysWhenItIsNotInTheAsymptoticRange) {
  EXPECT_EQ(extrapolate(sizes, std::vector<double>{1.0, 1.2, 1.1}).range,
            Extrapolation::Range::no_monotony);
  EXPECT_NEAR(extrapolate(sizes, std::vector<double>{1.0, 1.2, 1.1}).uncertainty[2], 0.6, 1e-12);
  const Extrapolation fast = extrapolate(sizes, power(10.0, 0.1, 4.0, sizes));
  EXPECT_EQ(fast.range, Extrapolation::Range::too_fast);
  EXPECT_GT(fast.uncertainty[2], std::abs(10.1 - 10.0)); // and it still holds the limit
  const Extrapolation slow = extrapolate(sizes, power(10.0, 5.0, 0.2, sizes));
  EXPECT_EQ(slow.range, Extrapolation::Range::too_slow);
  EXPECT_GE(slow.uncertainty[2], 2.99 * 5.0 * (std::pow(4.0, 0.2) - 1.0)); // 3 times the spread
}

TEST(Extrapolation, OfValuesThatDoNotChangeIsTheValue) {
  const Extrapolation found = extrapolate(sizes, std::vector<double>{3.0, 3.0, 3.0});
  EXPECT_EQ(found.range, Extrapolation::Range::constant);
  EXPECT_EQ(found.limit, 3.0);
  EXPECT_EQ(found.uncertainty[2], 0.0);
}

} // namespace
} // namespace billet::study::extrapolation_test
