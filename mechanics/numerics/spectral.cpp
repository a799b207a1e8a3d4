#include "mechanics/numerics/spectral.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace billet::mechanics {

namespace {

using Row = TensorsSideBySide::value_type;

/// Symmetric matrices and the rotations applied to them so far, entry by entry.
struct JacobiBatch {
  std::array<Row, 3> diagonal;              ///< entries 00, 11, 22
  std::array<Row, 3> off;                   ///< off[r]: the entry of the two axes other than r
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

void decompose(const TensorsSideBySide& A, SpectralSideBySide& out) {
  constexpr int max_sweeps = 20; // five do for any matrix met so far
  JacobiBatch batch(A);
  for (int sweep = 0; sweep < max_sweeps && !batch.converged(); ++sweep) {
    batch.rotate(0, 1, 2);
    batch.rotate(1, 2, 0);
    batch.rotate(2, 0, 1);
  }
  out.values = batch.diagonal;
  out.vectors = batch.axes;
}

/// By the half angle, (M.5); nothing cancels.
void decompose_in_plane(const TensorsSideBySide& A, SpectralSideBySide& out) {
  const Row zero{};
  const Row one = Row::constant(1.0);
  const Row& shear = A[3];
  const Row mean = 0.5 * (A[0] + A[1]);
  const Row half = 0.5 * (A[0] - A[1]);
  const Row radius = sqrt(half * half + shear * shear);
  out.values = {mean + radius, mean - radius, A[2]};
  // Through the larger of the two cosines; no angle where the values are equal.
  const Row differ = zero - radius;
  const Row share = where_negative(differ, abs(half) / radius, one);
  const Row larger = sqrt(0.5 * (one + share));
  const Row smaller = where_negative(differ, 0.5 * shear / (radius * larger), zero);
  const Row c = where_negative(half, abs(smaller), larger);
  const Row s = where_negative(half, where_negative(shear, zero - larger, larger), smaller);
  out.vectors = {{{c, s, zero}, {zero - s, c, zero}, {zero, zero, one}}};
}

namespace {

/// Decomposes one tensor as all of a batch.
template <class Decompose> Spectral alone(const Mat3& A, Decompose decompose) {
  TensorsSideBySide tensors;
  for (std::size_t k = 0; k < tensors.size(); ++k)
    tensors[k] = Row::constant(A(static_cast<Eigen::Index>(tensor_components[k][0]),
                                 static_cast<Eigen::Index>(tensor_components[k][1])));
  SpectralSideBySide batch;
  decompose(tensors, batch);
  Spectral S;
  for (int k = 0; k < 3; ++k) {
    const auto column = static_cast<std::size_t>(k);
    S.values[k] = batch.values[column][0];
    for (int i = 0; i < 3; ++i)
      S.vectors(i, k) = batch.vectors[column][static_cast<std::size_t>(i)][0];
  }
  return S;
}

} // namespace

Spectral spectral_plane(const Mat3& A) { return alone(A, decompose_in_plane); }

Spectral spectral(const Mat3& A) { return alone(A, decompose); }

} // namespace billet::mechanics
