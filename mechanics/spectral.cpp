#include "mechanics/spectral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace billet::mechanics {

Spectral spectral_plane(const Mat3& A) {
  const double mean = 0.5 * (A(0, 0) + A(1, 1));
  const double half = 0.5 * (A(0, 0) - A(1, 1));
  const double radius = std::sqrt(half * half + A(0, 1) * A(0, 1));
  Spectral S;
  S.values = Vec3(mean + radius, mean - radius, A(2, 2));
  S.vectors.setIdentity();
  if (radius > 0.0) {
    // The half angle through the larger of the two cosines, so that nothing cancels.
    double c = std::sqrt(0.5 * (1.0 + std::abs(half) / radius));
    double s = 0.5 * A(0, 1) / (radius * c);
    if (half < 0.0) {
      const double smaller = std::abs(s);
      s = std::copysign(c, A(0, 1));
      c = smaller;
    }
    S.vectors.col(0) = Vec3(c, s, 0.0);
    S.vectors.col(1) = Vec3(-s, c, 0.0);
  }
  return S;
}

namespace {

using Row = TensorsSideBySide::value_type;

/// Symmetric matrices and the rotations applied to them so far, entry by entry.
struct JacobiBatch {
  std::array<Row, 3> diagonal;            ///< entries 00, 11, 22
  std::array<Row, 3> off;                 ///< off[r]: the entry of the two axes other than r
  std::array<std::array<Row, 3>, 3> axes{}; ///< axes[k][i]: component i of column k

  explicit JacobiBatch(const TensorsSideBySide& A)
      : diagonal{A[0], A[1], A[2]}, off{A[4], A[5], A[3]} {
    for (std::size_t k = 0; k < 3; ++k)
      axes[k][k] = Row::constant(1.0);
  }

  /// Turns axes p and q so that their entry vanishes; r is the third one. (Jacobi 1846)
  void rotate(std::size_t p, std::size_t q, std::size_t r) {
    constexpr double tiny = 1e-300; // keeps 0 / 0 out of equal diagonals without an entry
    const Row one = Row::constant(1.0);
    const Row d = diagonal[q] - diagonal[p];
    const Row twice = 2.0 * off[r];
    const Row length = sqrt(d * d + twice * twice) + Row::constant(tiny);
    const Row t = twice / (d + where_negative(d, -1.0 * length, length));
    const Row c = one / sqrt(one + t * t);
    const Row s = t * c;
    diagonal[p] = diagonal[p] - t * off[r];
    diagonal[q] = diagonal[q] + t * off[r];
    off[r] = {};
    turn(off[q], off[p], c, s);
    for (std::size_t i = 0; i < 3; ++i)
      turn(axes[p][i], axes[q][i], c, s);
  }

  /// Whether no entry off a diagonal can change that diagonal any more; NaN stays out of it.
  [[nodiscard]] bool converged() const {
    constexpr double negligible = 1e-17;
    const Row size = abs(diagonal[0]) + abs(diagonal[1]) + abs(diagonal[2]);
    const Row excess = abs(off[0]) + abs(off[1]) + abs(off[2]) - negligible * size;
    bool any = false;
    for (int l = 0; l < tensors_at_once; ++l)
      any = any || excess[l] > 0.0;
    return !any;
  }

private:
  static void turn(Row& p, Row& q, const Row& c, const Row& s) {
    const Row before = p;
    p = c * before - s * q;
    q = s * before + c * q;
  }
};

} // namespace

SpectralSideBySide spectral(const TensorsSideBySide& A) {
  constexpr int most_sweeps = 20; // five do for any matrix met so far
  JacobiBatch batch(A);
  for (int sweep = 0; sweep < most_sweeps && !batch.converged(); ++sweep) {
    batch.rotate(0, 1, 2);
    batch.rotate(1, 2, 0);
    batch.rotate(2, 0, 1);
  }
  return {batch.diagonal, batch.axes};
}

void spectral(std::span<const Mat3> A, std::span<Spectral> out) {
  constexpr auto at_once = static_cast<std::size_t>(tensors_at_once);
  for (std::size_t first = 0; first < A.size(); first += at_once) {
    const std::size_t n = std::min(at_once, A.size() - first);
    TensorsSideBySide tensors;
    for (std::size_t k = 0; k < tensors.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(tensor_components[k][0]);
      const auto j = static_cast<Eigen::Index>(tensor_components[k][1]);
      tensors[k] = Row::of(
          [&](int l) { return A[first + std::min(static_cast<std::size_t>(l), n - 1)](i, j); });
    }
    const SpectralSideBySide batch = spectral(tensors);
    for (std::size_t l = 0; l < n; ++l)
      for (int k = 0; k < 3; ++k) {
        const auto column = static_cast<std::size_t>(k);
        out[first + l].values[k] = batch.values[column][static_cast<int>(l)];
        for (int i = 0; i < 3; ++i)
          out[first + l].vectors(i, k) =
              batch.vectors[column][static_cast<std::size_t>(i)][static_cast<int>(l)];
      }
  }
}

Spectral spectral(const Mat3& A) {
  Spectral S;
  spectral(std::span(&A, 1), std::span(&S, 1));
  return S;
}

} // namespace billet::mechanics
