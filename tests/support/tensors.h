// Small tensors for tests: rotations, exponentials and logarithms of symmetric tensors, and random
// numbers that are the same in every run.

#pragma once

#include "geometry/base/vector.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace billet::support {

inline constexpr double degree = std::numbers::pi / 180.0;

/// The numbers of one test; nothing depends on the library's distributions.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}

  /// Evenly spread over (low, high).
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) + 0.5) / 4294967296.0;
  }
  Vec3 vector(double half) {
    const double x = number(-half, half);
    const double y = number(-half, half);
    return {x, y, number(-half, half)};
  }
  std::vector<double> list(std::size_t n, double half) {
    std::vector<double> values(n);
    for (double& value : values)
      value = number(-half, half);
    return values;
  }
  /// Symmetric, entries of size `half`; without xz and yz entries when planar.
  Mat3 symmetric(double half, bool planar = false) {
    Mat3 A = Mat3::Zero();
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        if (!planar || j < 2 || i == 2)
          A(i, j) = A(j, i) = number(-half, half);
    return A;
  }

private:
  std::mt19937 engine_; // 32 bits a draw, the same everywhere
};

inline Mat3 rotation(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// f applied to the principal values of a symmetric tensor.
template <class Function> Mat3 isotropic(const Mat3& A, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(A);
  Vec3 values = solver.eigenvalues();
  for (double& value : values)
    value = f(value);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

inline Mat3 exponential(const Mat3& A) {
  return isotropic(A, [](double x) { return std::exp(x); });
}

inline Mat3 deviator(const Mat3& A) { return A - A.trace() / 3.0 * Mat3::Identity(); }

inline double von_mises(const Mat3& stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

/// Cauchy stress of Hencky elasticity at a deformation gradient, from the definition [MPa].
inline Mat3 hencky_stress(double young, double poisson, const Mat3& F) {
  const Mat3 strain = isotropic(F * F.transpose(), [](double b) { return 0.5 * std::log(b); });
  const double shear = young / (2.0 * (1.0 + poisson));
  const double bulk = young / (3.0 * (1.0 - 2.0 * poisson));
  const Mat3 tau = 2.0 * shear * deviator(strain) + bulk * strain.trace() * Mat3::Identity();
  return tau / F.determinant();
}

} // namespace billet::support
