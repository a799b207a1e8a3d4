#include "mechanics/spectral.h"

#include <Eigen/Eigenvalues>

namespace billet::mechanics {

Spectral spectral_plane(const Mat3& A) {
  const double mean = 0.5 * (A(0, 0) + A(1, 1));
  const double half = 0.5 * (A(0, 0) - A(1, 1));
  const double radius = std::hypot(half, A(0, 1));
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

Spectral spectral(const Mat3& A) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

} // namespace billet::mechanics
