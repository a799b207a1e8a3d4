// Spectral decomposition of symmetric 3x3 tensors, and the logarithm's divided difference.
//
// Theory: docs/theory/mechanics.md (M.5), (M.8).

#pragma once

#include "geometry/base/vector.h"

#include <cmath>
#include <span>

namespace billet::mechanics {

/// A = sum_a values[a] n_a (x) n_a, n_a the columns of `vectors`.
struct Spectral {
  Vec3 values;  ///< eigenvalues, in no particular order
  Mat3 vectors; ///< orthonormal columns
};

/// Decomposition of a symmetric tensor whose xz and yz entries vanish (plane and axisymmetric).
[[nodiscard]] Spectral spectral_plane(const Mat3& A);

/// Decomposition of a symmetric tensor.
[[nodiscard]] Spectral spectral(const Mat3& A);
/// Decompositions of symmetric tensors, shape (n): Jacobi rotations of several side by side, which
/// give small eigenvalues to the same relative accuracy as large ones.
void spectral(std::span<const Mat3> A, std::span<Spectral> out);

/// (ln a - ln b) / (a - b) * b for a, b > 0: exact to rounding for equal and nearly equal
/// arguments, which need no perturbation. (M.8)
[[nodiscard]] inline double log_difference(double a, double b) {
  const double x = (a - b) / b;
  constexpr double small = 1.0 / 64.0; // as elastic strains of metals are: nine terms do
  if (std::abs(x) < small) {
    double sum = 0.0;
    for (int n = 9; n >= 1; --n)
      sum = 1.0 / n - x * sum;
    return sum;
  }
  return std::log1p(x) / x;
}

} // namespace billet::mechanics
