// Gauss-Legendre rules on the reference line, square and cube [-1, 1]^d, as tensor products.

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

} // namespace billet::mechanics
