// Curved pieces: they are the quadratic through their points, and lie in the hull of their control
// points, before and after halving.

#include "geometry/curved/bezier_patch.h"
#include "tests/geometry/surface_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace billet::geometry::bezier_patch_test {
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

/// The triangle through 6 points in rows of 3, 2 and 1, at barycentric coordinates of its corners.
Vec3 in_triangle(const std::vector<Vec3>& at, const Vec3& l) {
  return l[0] * (2 * l[0] - 1) * at[0] + l[1] * (2 * l[1] - 1) * at[2] +
         l[2] * (2 * l[2] - 1) * at[5] + 4 * l[0] * l[1] * at[1] + 4 * l[1] * l[2] * at[4] +
         4 * l[2] * l[0] * at[3];
}

/// The same by the control points.
Vec3 in_triangle(const BezierPatch& patch, const Vec3& l) {
  const auto c = patch.control();
  return l[0] * l[0] * c[0] + l[1] * l[1] * c[2] + l[2] * l[2] * c[5] + 2 * l[0] * l[1] * c[1] +
         2 * l[1] * l[2] * c[4] + 2 * l[2] * l[0] * c[3];
}

/// A grid of barycentric coordinates.
std::vector<Vec3> barycentric_grid(int n) {
  std::vector<Vec3> grid;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      grid.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n,
                        static_cast<double>(n - i - j) / n);
  return grid;
}

TEST(BezierPatch, OfATrianglePassesThroughItsPointsAndStaysTheSameInHalves) {
  for (const std::size_t longest : {0U, 1U, 2U}) {
    std::vector<Vec3> at = random_points(6, 0.1);
    at[0] += Vec3(longest == 1 ? 0.6 : 0.0, 0, 0); // the side opposite is the longest, or b or c
    at[2] += Vec3(1, longest == 2 ? -0.4 : 0.0, 0);
    at[5] += Vec3(0, longest == 0 ? 0.5 : 1.0, 0);
    at[1] += 0.5 * (at[0] + at[2]);
    at[3] += 0.5 * (at[0] + at[5]);
    at[4] += 0.5 * (at[2] + at[5]);
    const BezierPatch patch(at);
    EXPECT_LT((patch.centre() - in_triangle(at, Vec3::Constant(1.0 / 3.0))).norm(), rounding);
    const auto halves = patch.halves();
    std::array<double, 3> best{1.0, 1.0, 1.0};
    for (const Vec3& l : barycentric_grid(7)) {
      EXPECT_LT((in_triangle(patch, l) - in_triangle(at, l)).norm(), rounding);
    }
    // A half is the whole with corner b moved to the middle of the side from a, or the other way.
    for (std::size_t a = 0; a < 3; ++a) {
      const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>((a + 1) % 3);
      best[a] = 0.0;
      for (const Vec3& l : barycentric_grid(7)) {
        Vec3 first = l, second = l;
        first[i] += 0.5 * l[j];
        first[j] *= 0.5;
        second[j] += 0.5 * l[i];
        second[i] *= 0.5;
        best[a] = std::max({best[a], (in_triangle(halves[0], l) - in_triangle(at, first)).norm(),
                            (in_triangle(halves[1], l) - in_triangle(at, second)).norm()});
      }
    }
    EXPECT_LT(*std::min_element(best.begin(), best.end()), rounding);
  }
}

TEST(BezierPatch, OfATriangleHasNoPointFartherThanItSays) {
  const std::vector<Vec3> from = random_points(20, 3.0);
  BezierPatch patch(random_points(6, 1.0));
  for (int level = 0; level < 6; ++level) {
    for (const Vec3& x : from)
      for (const Vec3& l : barycentric_grid(12))
        EXPECT_LE((in_triangle(patch, l) - x).norm(), patch.farthest(x) + rounding);
    patch = patch.halves()[static_cast<std::size_t>(level % 2)];
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
} // namespace billet::geometry::bezier_patch_test
