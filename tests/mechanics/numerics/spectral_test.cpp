#include "mechanics/numerics/spectral.h"
#include "tests/support/figures.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace billet::mechanics::spectral_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
/// A backward stable decomposition reproduces the tensor to a few roundings of its norm.
constexpr double rounding = 16.0 * eps;

Mat3 composed(const Spectral& S) {
  return S.vectors * S.values.asDiagonal() * S.vectors.transpose();
}

/// Largest error of reconstruction and orthonormality, relative.
double error(const Spectral& S, const Mat3& A) {
  const double orthonormal = (S.vectors.transpose() * S.vectors - Mat3::Identity()).norm();
  return std::max((composed(S) - A).norm() / A.norm(), orthonormal);
}

Mat3 plane(double xx, double yy, double zz, double xy) {
  Mat3 A = Vec3(xx, yy, zz).asDiagonal();
  A(0, 1) = A(1, 0) = xy;
  return A;
}

TEST(Spectral, in_the_plane_reproduces_the_tensor_to_rounding) {
  support::Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Mat3 A = Mat3::Identity() + random.symmetric(0.9, true);
    worst = std::max(worst, error(spectral_plane(A), A));
  }
  // All quadrants, equal, nearly equal and hardly coupled diagonal entries.
  for (const double half : {0.0, 1e-300, 1e-18, 1e-12, 1e-6, 0.1})
    for (const double shear : {0.0, 1e-300, 1e-18, 1e-12, 1e-6, 0.1})
      for (const double sign : {1.0, -1.0})
        for (const double turn : {1.0, -1.0}) {
          const Mat3 A = plane(1.0 + sign * half, 1.0 - sign * half, 1.0, turn * shear);
          worst = std::max(worst, error(spectral_plane(A), A));
        }
  support::show_error("spectral", "plane, reconstruction", worst, rounding);
  EXPECT_LE(worst, rounding);
}

TEST(Spectral, in_the_plane_agrees_with_the_one_in_space) {
  support::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Mat3 A = 2.0 * Mat3::Identity() + random.symmetric(1.0, true);
    Vec3 flat = spectral_plane(A).values;
    Vec3 space = spectral(A).values;
    std::sort(flat.begin(), flat.end());
    std::sort(space.begin(), space.end());
    EXPECT_LE((flat - space).norm(), rounding * A.norm());
  }
}

TEST(Spectral, in_space_reproduces_the_tensor_to_rounding_also_with_equal_values) {
  support::Random random(3);
  double worst = 0.0;
  for (const double split : {0.0, 1e-16, 1e-14, 1e-10, 1e-5, 0.3})
    for (int i = 0; i < 200; ++i) {
      const Mat3 R = support::rotation(random.vector(1.0), random.number(0.0, 6.0));
      const Mat3 D = Vec3(1.0, 1.0 + split, 1.0 - (i % 2) * split).asDiagonal();
      Mat3 A = R * D * R.transpose();
      A = 0.5 * (A + A.transpose()).eval();
      worst = std::max(worst, error(spectral(A), A));
    }
  support::show_error("spectral", "space, reconstruction", worst, rounding);
  EXPECT_LE(worst, rounding);
}

long double exact_log_difference(double a, double b) {
  const long double x = a;
  const long double y = b;
  return a == b ? 1.0L : (std::log(x) - std::log(y)) / (x - y) * y;
}

TEST(LogDifference, is_exact_to_rounding_for_equal_and_nearly_equal_values) {
  constexpr double allowed = 4.0 * eps;
  double worst = 0.0;
  for (double b : {1.0, 0.37, 5.3e-3, 812.0})
    for (int exponent = -16; exponent <= -1; ++exponent)
      for (const double sign : {1.0, -1.0}) {
        const double a = b * (1.0 + sign * std::pow(10.0, exponent));
        // The reference itself cancels: log1p of the exact difference is exact in long double.
        const long double x = (static_cast<long double>(a) - b) / b;
        const long double reference = a == b ? 1.0L : std::log1p(x) / x;
        const double difference =
            static_cast<double>(std::abs((log_difference(a, b) - reference) / reference));
        worst = std::max(worst, difference);
      }
  EXPECT_EQ(log_difference(0.7, 0.7), 1.0);
  support::show_error("log_difference", "nearly equal", worst, allowed);
  EXPECT_LE(worst, allowed);
}

TEST(LogDifference, is_the_divided_difference_of_the_logarithm) {
  // For a << b the difference a - b loses digits of a: eps * b / a.
  double worst = 0.0;
  for (const double a : {0.02, 0.1, 0.6, 1.7, 9.0, 40.0})
    for (const double b : {0.02, 0.1, 0.6, 1.7, 9.0, 40.0}) {
      const auto reference = static_cast<double>(exact_log_difference(a, b));
      const double allowed = 8.0 * eps * std::max(1.0, b / a);
      const double error = std::abs(log_difference(a, b) - reference) / reference;
      worst = std::max(worst, error / allowed);
    }
  EXPECT_LE(worst, 1.0);
}

} // namespace
} // namespace billet::mechanics::spectral_test
