// Integration rules: Gauss-Legendre on the reference line, square and cube [-1, 1]^d, as tensor
// products; symmetric rules on the reference triangle and tetrahedron.

#pragma once

#include <array>
#include <cstddef>

namespace billet::mechanics {

/// Points and weights of an n-point Gauss rule on [-1, 1]; exact for degree 2 n - 1.
template <int n> struct GaussLine;
template <> struct GaussLine<1> {
  static constexpr std::array<double, 1> x{0.0};
  static constexpr std::array<double, 1> w{2.0};
};
template <> struct GaussLine<2> {
  static constexpr std::array<double, 2> x{-0.57735026918962576451, 0.57735026918962576451};
  static constexpr std::array<double, 2> w{1.0, 1.0};
};
template <> struct GaussLine<3> {
  static constexpr std::array<double, 3> x{-0.77459666924148337704, 0.0, 0.77459666924148337704};
  static constexpr std::array<double, 3> w{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
};

/// n^dim points; the first coordinate runs fastest.
template <int dim, int n> struct GaussRule {
  static constexpr int per_direction = n;
  static constexpr int points = dim == 1 ? n : dim == 2 ? n * n : n * n * n;

  static constexpr std::array<double, dim> point(int i) {
    std::array<double, dim> xi{};
    for (std::size_t d = 0; d < dim; ++d, i /= n)
      xi[d] = GaussLine<n>::x[static_cast<std::size_t>(i % n)];
    return xi;
  }
  static constexpr double weight(int i) {
    double w = 1.0;
    for (int d = 0; d < dim; ++d, i /= n)
      w *= GaussLine<n>::w[static_cast<std::size_t>(i % n)];
    return w;
  }
};

/// Symmetric rules with positive weights and points inside the simplex xi_i >= 0, sum xi_i <= 1;
/// the weights sum to its area 1/2 or volume 1/6. Point i (of the first dim + 1) lies towards
/// corner i. (M.31)
template <int dim, int n> struct SimplexRule;

/// Points of a family: barycentric coordinate `own` of one corner, `other` of all the others.
template <int dim>
constexpr std::array<double, dim> simplex_point(std::size_t corner, double own, double other) {
  std::array<double, dim> xi{};
  xi.fill(other);
  if (corner > 0)
    xi[corner - 1] = own;
  return xi;
}

/// Exact for degree 2.
template <> struct SimplexRule<2, 3> {
  static constexpr int points = 3;
  static constexpr std::array<double, 2> point(int i) {
    return simplex_point<2>(static_cast<std::size_t>(i), 2.0 / 3.0, 1.0 / 6.0);
  }
  static constexpr double weight(int) { return 1.0 / 6.0; }
};

/// Exact for degree 4: three points towards the corners, then three towards the sides opposite to
/// them (G. R. Cowper, Int. J. Numer. Meth. Engng 7 (1973) 405-408).
template <> struct SimplexRule<2, 6> {
  static constexpr int points = 6;
  static constexpr std::array<double, 2> share{0.10995174365532186764, 0.22338158967801146570};
  static constexpr std::array<double, 2> other{0.09157621350977074346, 0.44594849091596488632};
  static constexpr std::array<double, 2> point(int i) {
    const auto k = static_cast<std::size_t>(i);
    return simplex_point<2>(k % 3, 1.0 - 2.0 * other[k / 3], other[k / 3]);
  }
  static constexpr double weight(int i) { return 0.5 * share[static_cast<std::size_t>(i / 3)]; }
};

/// Exact for degree 1.
template <> struct SimplexRule<3, 1> {
  static constexpr int points = 1;
  static constexpr std::array<double, 3> point(int) { return {0.25, 0.25, 0.25}; }
  static constexpr double weight(int) { return 1.0 / 6.0; }
};

/// Exact for degree 2.
template <> struct SimplexRule<3, 4> {
  static constexpr int points = 4;
  static constexpr double other = 0.13819660112501051518; ///< (5 - sqrt 5) / 20
  static constexpr std::array<double, 3> point(int i) {
    return simplex_point<3>(static_cast<std::size_t>(i), 1.0 - 3.0 * other, other);
  }
  static constexpr double weight(int) { return 1.0 / 24.0; }
};

} // namespace billet::mechanics
