// Batches of the integration points of elements side by side: who stands where, shape functions
// there, and small matrices at all of them.

#pragma once

#include "geometry/base/index.h"
#include "mechanics/elements/elements.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/numerics/simd_pack.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace billet::mechanics {

/// Points of elements side by side in a batch; beyond the last point stands the last once more.
template <class Element> struct Places {
  static constexpr int points = Element::Rule::points;
  static_assert(points <= points_at_once);
  static constexpr int elements = points_at_once / points;

  static constexpr int element(int place) { return std::min(place / points, elements - 1); }
  static constexpr int point(int place) {
    return std::min(place - element(place) * points, points - 1);
  }
};

/// Shape functions and their reference gradients at every integration point of an element, node by
/// node, and of a batch, point by point.
template <class Element> struct PointTable {
  static constexpr int nodes = Element::Shape::nodes;
  static constexpr int dim = Element::Shape::dim;
  static constexpr int points = Element::Rule::points;

  std::array<SimdPack<nodes>, points> N{};
  std::array<std::array<SimdPack<nodes>, dim>, points> dN{}; ///< by each reference coordinate
  std::array<PointPack, nodes> N_at_points{};
  std::array<std::array<PointPack, dim>, nodes> dN_at_points{};
  PointPack weight{};

  PointTable() {
    for (int place = 0; place < points_at_once; ++place) {
      const int g = Places<Element>::point(place);
      const auto xi = Element::Rule::point(g);
      const auto values = Element::Shape::values(xi);
      const auto gradients = Element::Shape::gradients(xi);
      weight.set(place, Element::Rule::weight(g));
      for (int a = 0; a < nodes; ++a) {
        N[idx(g)].set(a, values[idx(a)]);
        N_at_points[idx(a)].set(place, values[idx(a)]);
        for (std::size_t i = 0; i < dim; ++i) {
          dN[idx(g)][i].set(a, gradients[idx(a)][i]);
          dN_at_points[idx(a)][i].set(place, gradients[idx(a)][i]);
        }
      }
    }
  }
};

template <class Element> const PointTable<Element>& point_table() {
  static const PointTable<Element> table;
  return table;
}

/// A square matrix at each point of a batch.
template <int dim> using SquarePack = std::array<std::array<PointPack, dim>, dim>;

inline PointPack determinant(const SquarePack<2>& A) {
  return A[0][0] * A[1][1] - A[0][1] * A[1][0];
}

/// The matrix of cofactors' transpose: the inverse times the determinant.
inline SquarePack<2> adjugate(const SquarePack<2>& A) {
  return {{{A[1][1], -1.0 * A[0][1]}, {-1.0 * A[1][0], A[0][0]}}};
}

inline SquarePack<3> adjugate(const SquarePack<3>& A) {
  SquarePack<3> C;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t p = (j + 1) % 3;
      const std::size_t q = (j + 2) % 3;
      const std::size_t r = (i + 1) % 3;
      const std::size_t s = (i + 2) % 3;
      C[i][j] = A[p][r] * A[q][s] - A[p][s] * A[q][r];
    }
  return C;
}

inline PointPack determinant(const SquarePack<3>& A) {
  PointPack sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum += A[0][i] * (A[1][j] * A[2][k] - A[1][k] * A[2][j]);
  }
  return sum;
}

} // namespace billet::mechanics
