// Spectral decomposition of symmetric 3x3 tensors, and the logarithm's divided difference.
//
// Theory: docs/theory/mechanics.md (M.5), (M.8).

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/numerics/simd_pack.h"

#include <array>
#include <cmath>
#include <cstddef>

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

/// Row and column of each component of a symmetric tensor; also the axes of each of the strains in
/// principal axes: those along the axes 0, 1, 2 and the shears 01, 12, 02.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tensor_components{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Tensors decomposed side by side: two batches of points, a vector of the widest processors.
inline constexpr int tensors_at_once = 8;
using TensorsSideBySide = std::array<SimdPack<tensors_at_once>, 6>; ///< by component

struct SpectralSideBySide {
  std::array<SimdPack<tensors_at_once>, 3> values;                 ///< in no particular order
  std::array<std::array<SimdPack<tensors_at_once>, 3>, 3> vectors; ///< vectors[a][i], of value a
};

/// Decompositions of symmetric tensors by Jacobi rotations, which give small eigenvalues to the
/// same relative accuracy as large ones.
void decompose(const TensorsSideBySide& A, SpectralSideBySide& out);

/// Decompositions of symmetric tensors whose xz and yz entries vanish (plane and axisymmetric).
void decompose_in_plane(const TensorsSideBySide& A, SpectralSideBySide& out);

/// Coefficients of artanh(z) / z in powers of z^2, the last first.
inline constexpr std::array<double, 11> artanh_series{
    1.0 / 21.0, 1.0 / 19.0, 1.0 / 17.0, 1.0 / 15.0, 1.0 / 13.0, 1.0 / 11.0,
    1.0 / 9.0,  1.0 / 7.0,  1.0 / 5.0,  1.0 / 3.0,  1.0};

/// Up to which |z| that series is exact to rounding: where ln((1 + z) / (1 - z)) is half of ln 2.
inline constexpr double artanh_series_reach = 0.1715;

/// (ln a - ln b) / (a - b) * b for a, b > 0: exact to rounding for equal and nearly equal
/// arguments, which need no perturbation. (M.8)
[[nodiscard]] inline double log_difference(double a, double b) {
  const double z = (a - b) / (a + b);
  if (!(std::abs(z) <= artanh_series_reach)) {
    const double x = (a - b) / b;
    return std::log1p(x) / x;
  }
  double sum = 0.0;
  for (const double coefficient : artanh_series)
    sum = coefficient + z * z * sum;
  return 2.0 * b / (a + b) * sum;
}

} // namespace billet::mechanics
