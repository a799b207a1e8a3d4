// Curved pieces: they are the quadratic through their points, and lie in the hull of their control
// points, before and after halving.

#include "geometry/bezier_patch.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace billet::geometry {
namespace {

constexpr double rounding = 1e-14; // of coordinates of order 1

std::array<double, 3> lagrange(double xi) {
  return {0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)};
}

/// The curve (3 points) or patch (9) through `at`, by Lagrange's formula.
Vec3 interpolated(const std::vector<Vec3>& at, double xi, double eta) {
  const auto along = lagrange(xi), across = lagrange(eta);
  Vec3 x = Vec3::Zero();
  for (std::size_t i = 0; i < at.size(); ++i)
    x += along[i % 3] * (at.size() == 3 ? 1.0 : across[i / 3]) * at[i];
  return x;
}

/// The same by the control points.
Vec3 on(const BezierPatch& patch, double xi, double eta) {
  const auto bernstein = [](double x) {
    const double t = 0.5 * (1.0 + x);
    return std::array{(1 - t) * (1 - t), 2 * t * (1 - t), t * t};
  };
  const auto along = bernstein(xi), across = bernstein(eta);
  Vec3 x = Vec3::Zero();
  for (std::size_t i = 0; i < patch.control().size(); ++i)
    x += along[i % 3] * (patch.control().size() == 3 ? 1.0 : across[i / 3]) * patch.control()[i];
  return x;
}

TEST(BezierPatch, PassesThroughItsPointsAndStaysTheSameInHalves) {
  for (const std::size_t n : {3u, 9u}) {
    const std::vector<Vec3> at = random_points(n, 1.0);
    const BezierPatch patch(at);
    EXPECT_LT((patch.centre() - at[n / 2]).norm(), rounding);
    const auto halves = patch.halves();
    double split_xi = 0.0, split_eta = 0.0;
    for (const double xi : {-1.0, -0.3, 0.6, 1.0})
      for (const double eta : {-1.0, 0.2, 1.0}) {
        const Vec3 x = on(halves[0], xi, eta);
        EXPECT_LT((on(patch, xi, eta) - interpolated(at, xi, eta)).norm(), rounding);
        split_xi = std::max(split_xi, (x - on(patch, 0.5 * (xi - 1.0), eta)).norm());
        split_eta = std::max(split_eta, (x - on(patch, xi, 0.5 * (eta - 1.0))).norm());
      }
    EXPECT_LT(n == 3 ? split_xi : std::min(split_xi, split_eta), rounding);
  }
}

TEST(BezierPatch, HasNoPointFartherThanItSays) {
  const std::vector<Vec3> from = random_points(20, 3.0);
  for (const std::size_t n : {3u, 9u}) {
    BezierPatch patch(random_points(n, 1.0));
    for (int level = 0; level < 4; ++level) {
      for (const Vec3& x : from)
        for (int i = 0; i <= 20; ++i)
          for (int j = 0; j <= (n == 3 ? 0 : 20); ++j)
            EXPECT_LE((on(patch, 0.1 * i - 1.0, 0.1 * j - 1.0) - x).norm(),
                      patch.farthest(x) + rounding);
      patch = patch.halves()[static_cast<std::size_t>(level % 2)];
    }
  }
}

TEST(BezierPatch, IsCutAcrossItsLongerSide) {
  std::vector<Vec3> at;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      at.emplace_back(i, 5.0 * j, 0.0);
  const auto halves = BezierPatch(at).halves();
  EXPECT_LT((halves[0].centre() - Vec3(1.0, 2.5, 0.0)).norm(), rounding);
  EXPECT_LT((halves[1].centre() - Vec3(1.0, 7.5, 0.0)).norm(), rounding);
}

} // namespace
} // namespace billet::geometry
