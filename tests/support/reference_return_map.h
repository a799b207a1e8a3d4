// The J2 return map once more, slowly and in extended precision (64-bit mantissa), as a reference.
//
// Tensors go in and come out; nothing is shared with the sources but the definition: logarithmic
// strains of the predictor, von Mises stress q, and q - 3 G d = sigma_y(old + d) by bisection.

#pragma once

#include "mechanics/materials/j2_hencky.h"
#include "tests/support/tensors.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>

namespace billet::support {

using Long = long double;
using LongMat3 = Eigen::Matrix<Long, 3, 3>;
using LongVec3 = Eigen::Matrix<Long, 3, 1>;

struct ReferenceReturn {
  LongMat3 s;          ///< deviatoric Kirchhoff stress [MPa]
  LongMat3 b_e;        ///< elastic state after the return [-]
  Long plastic_strain; ///< accumulated [-]
};

/// @param yield  flow stress at a plastic strain [MPa]
inline ReferenceReturn reference_return(const mechanics::Elasticity& elasticity,
                                        const std::function<Long(Long)>& yield,
                                        const LongMat3& b_pred,
                                        Long old) {
  const Long G = Long(elasticity.young) / (2.0L * (1.0L + Long(elasticity.poisson)));
  const Eigen::SelfAdjointEigenSolver<LongMat3> solver(b_pred);
  LongVec3 strain = solver.eigenvalues();
  for (Long& value : strain)
    value = std::log(value) / 2.0L;
  const Long volume = strain.sum() / 3.0L;
  strain -= LongVec3::Constant(volume);
  const Long q = std::sqrt(1.5L) * 2.0L * G * strain.norm();
  Long d = 0.0L;
  if (q > yield(old)) {
    Long low = 0.0L;
    Long high = q / (3.0L * G);
    for (int i = 0; i < 200; ++i) {
      d = 0.5L * (low + high);
      (q - 3.0L * G * d > yield(old + d) ? low : high) = d;
    }
    strain *= 1.0L - 3.0L * G * d / q;
  }
  LongVec3 stretch = strain;
  for (Long& value : stretch)
    value = std::exp(2.0L * (value + volume));
  const LongMat3& n = solver.eigenvectors();
  return {n * (2.0L * G * strain).asDiagonal() * n.transpose(),
          n * stretch.asDiagonal() * n.transpose(), old + d};
}

} // namespace billet::support
