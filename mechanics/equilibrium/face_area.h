// How the area vector of a face changes with the positions of its nodes. (M.15)

#pragma once

#include "mechanics/equilibrium/faces.h"

#include <cstddef>
#include <numbers>

namespace billet::mechanics {

/// d (n dA) / d (position of node b): the skew matrix of the moved tangents.
template <class Shape>
Mat3 area_derivative(const FacePoint<Shape>& at, std::size_t b, Analysis analysis, double weight) {
  Mat3 D = Mat3::Zero();
  if constexpr (Shape::dim == 1) {
    D(0, 1) = at.dN[b][0] * at.turn * weight;
    D(1, 0) = -at.dN[b][0] * at.turn * weight;
    if (analysis == Analysis::axisymmetric)
      D.col(0) += at.N[b] * 2.0 * std::numbers::pi * weight *
                  Vec3(at.tangents[0][1], -at.tangents[0][0], 0.0);
  } else {
    const Vec3 v = weight * (at.dN[b][1] * at.tangents[0] - at.dN[b][0] * at.tangents[1]);
    D << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  }
  return D;
}

} // namespace billet::mechanics
