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

/// Matrices decomposed side by side: one processor vector of them.
constexpr std::size_t lanes = 8;
using Row = std::array<double, lanes>;

/// Symmetric matrices and the rotations applied to them so far, entry by entry.
struct JacobiBatch {
  std::array<Row, 3> diagonal;            ///< entries 00, 11, 22
  std::array<Row, 3> off;                 ///< off[r]: the entry of the two axes other than r
  std::array<std::array<Row, 3>, 3> axes; ///< axes[k][i]: component i of column k

  JacobiBatch(std::span<const Mat3> A) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const Mat3& M = A[std::min(l, A.size() - 1)];
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        diagonal[i][l] = M(k, k);
        off[i][l] = M((k + 1) % 3, (k + 2) % 3);
        for (std::size_t j = 0; j < 3; ++j)
          axes[i][j][l] = i == j ? 1.0 : 0.0;
      }
    }
  }

  /// Turns axes p and q so that their entry vanishes; r is the third one. (Jacobi 1846)
  void rotate(std::size_t p, std::size_t q, std::size_t r) {
    constexpr double tiny = 1e-300; // keeps 0 / 0 out of equal diagonals without an entry
    Row t;
    Row c;
    Row s;
    for (std::size_t l = 0; l < lanes; ++l) {
      const double d = diagonal[q][l] - diagonal[p][l];
      const double twice = 2.0 * off[r][l];
      t[l] = twice / (d + std::copysign(std::sqrt(d * d + twice * twice) + tiny, d));
      c[l] = 1.0 / std::sqrt(1.0 + t[l] * t[l]);
      s[l] = t[l] * c[l];
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      diagonal[p][l] -= t[l] * off[r][l];
      diagonal[q][l] += t[l] * off[r][l];
      off[r][l] = 0.0;
      turn(off[q][l], off[p][l], c[l], s[l]);
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t l = 0; l < lanes; ++l)
        turn(axes[p][i][l], axes[q][i][l], c[l], s[l]);
  }

  /// Largest entry off the diagonals, relative to its matrix; NaN stays out of it.
  [[nodiscard]] double largest_off() const {
    double most = 0.0;
    for (std::size_t l = 0; l < lanes; ++l) {
      const double size =
          std::abs(diagonal[0][l]) + std::abs(diagonal[1][l]) + std::abs(diagonal[2][l]);
      const double entries = std::abs(off[0][l]) + std::abs(off[1][l]) + std::abs(off[2][l]);
      most = std::max(most, entries > 0.0 ? entries / size : 0.0);
    }
    return most;
  }

private:
  static void turn(double& p, double& q, double c, double s) {
    const double before = p;
    p = c * before - s * q;
    q = s * before + c * q;
  }
};

} // namespace

void spectral(std::span<const Mat3> A, std::span<Spectral> out) {
  constexpr double converged = 1e-17; // of an entry: it cannot change a diagonal any more
  constexpr int most_sweeps = 20;     // five do for any matrix met so far
  for (std::size_t first = 0; first < A.size(); first += lanes) {
    const std::size_t n = std::min(lanes, A.size() - first);
    JacobiBatch batch(A.subspan(first, n));
    for (int sweep = 0; sweep < most_sweeps && batch.largest_off() > converged; ++sweep) {
      batch.rotate(0, 1, 2);
      batch.rotate(1, 2, 0);
      batch.rotate(2, 0, 1);
    }
    for (std::size_t l = 0; l < n; ++l)
      for (int k = 0; k < 3; ++k) {
        const auto column = static_cast<std::size_t>(k);
        out[first + l].values[k] = batch.diagonal[column][l];
        for (int i = 0; i < 3; ++i)
          out[first + l].vectors(i, k) = batch.axes[column][static_cast<std::size_t>(i)][l];
      }
  }
}

Spectral spectral(const Mat3& A) {
  Spectral S;
  spectral(std::span(&A, 1), std::span(&S, 1));
  return S;
}

} // namespace billet::mechanics
