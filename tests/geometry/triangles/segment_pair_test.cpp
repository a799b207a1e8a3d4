#include "geometry/triangles/segment_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace billet::geometry::segment_pair_test {
namespace {

constexpr double precision = 1e-12;

/// Smallest distance of points spread over both, and of their ends.
double sampled_distance(const Segment& a, const Segment& b, int n) {
  double least = (a.from - b.from).norm();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Vec2 p = a.from + (a.to - a.from) * i / n, q = b.from + (b.to - b.from) * j / n;
      least = std::min(least, (p - q).norm());
    }
  return least;
}

TEST(SegmentPair, DistancesAgreeWithSampling) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto point = [&] { return Vec2(coordinate(generator), coordinate(generator)); };
  constexpr int n = 100;
  for (int k = 0; k < 200; ++k) {
    const Segment a{point(), point()}, b{point(), point()};
    const double sampled = sampled_distance(a, b, n);
    const double spacing = ((a.to - a.from).norm() + (b.to - b.from).norm()) / n;
    EXPECT_LE(distance(a, b), sampled + precision);
    EXPECT_GE(distance(a, b), sampled - spacing);
  }
}

TEST(SegmentPair, ACutIsAsDeepAsTheShorterPartBeyond) {
  const Segment floor{{-5, 0}, {5, 0}}, tip{{1, 3}, {1, -0.25}};
  EXPECT_NEAR(cut_depth(floor, tip), 0.25, precision);
  EXPECT_NEAR(cut_depth(tip, floor), 0.25, precision);
  EXPECT_NEAR((crossing(floor, tip) - Vec2(1, 0)).norm(), 0.0, precision);
  EXPECT_EQ(distance(floor, tip), 0.0);
}

TEST(SegmentPair, TouchingOrParallelSegmentsDoNotCut) {
  const Segment floor{{-5, 0}, {5, 0}};
  EXPECT_EQ(cut_depth(floor, {{1, 3}, {1, 0}}), 0.0);
  EXPECT_EQ(cut_depth(floor, {{-1, 0}, {1, 0}}), 0.0);
  EXPECT_NEAR(distance(floor, {{1, 3}, {1, 0}}), 0.0, precision);
  EXPECT_NEAR(distance(floor, {{8, 4}, {8, 9}}), 5.0, precision);
}

} // namespace
} // namespace billet::geometry::segment_pair_test
