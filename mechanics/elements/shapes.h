// Shape functions of lines, quadrilaterals and hexahedra on [-1, 1]^d, and of triangles and
// tetrahedra on the simplex xi_i >= 0, sum xi_i <= 1.
//
// A shape is a value type: `dim`, `nodes`, the reference coordinates of the nodes, and
// `values(xi)` and `gradients(xi)`. Node order is VTK's (mechanics/mesh/mesh.h); of a line3: both
// ends, then the middle. Theory: docs/theory/mechanics.md (M.2), (M.30).

#pragma once

#include <array>
#include <cstddef>

namespace billet::mechanics {

template <int dim> using RefPoint = std::array<double, dim>;
template <int nodes> using ShapeValues = std::array<double, nodes>;
template <int nodes, int dim> using ShapeGradients = std::array<std::array<double, dim>, nodes>;

/// 2-node line.
struct Line2 {
  static constexpr int dim = 1;
  static constexpr int nodes = 2;
  static constexpr std::array<RefPoint<1>, 2> corners{{{-1}, {1}}};

  static constexpr ShapeValues<2> values(const RefPoint<1>& xi) {
    return {0.5 * (1 - xi[0]), 0.5 * (1 + xi[0])};
  }
  static constexpr ShapeGradients<2, 1> gradients(const RefPoint<1>&) { return {{{-0.5}, {0.5}}}; }
};

/// 3-node line; N1 = -xi (1 - xi) / 2 (the paper prints the opposite sign, DESIGN §5).
struct Line3 {
  static constexpr int dim = 1;
  static constexpr int nodes = 3;
  static constexpr std::array<RefPoint<1>, 3> corners{{{-1}, {1}, {0}}};

  static constexpr ShapeValues<3> values(const RefPoint<1>& xi) {
    return {-0.5 * xi[0] * (1 - xi[0]), 0.5 * xi[0] * (1 + xi[0]), 1 - xi[0] * xi[0]};
  }
  static constexpr ShapeGradients<3, 1> gradients(const RefPoint<1>& xi) {
    return {{{xi[0] - 0.5}, {xi[0] + 0.5}, {-2 * xi[0]}}};
  }
};

/// Bilinear quadrilateral.
struct Quad4 {
  static constexpr int dim = 2;
  static constexpr int nodes = 4;
  static constexpr std::array<RefPoint<2>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

  static constexpr ShapeValues<4> values(const RefPoint<2>& xi) {
    ShapeValues<4> N{};
    for (std::size_t a = 0; a < 4; ++a)
      N[a] = 0.25 * (1 + corners[a][0] * xi[0]) * (1 + corners[a][1] * xi[1]);
    return N;
  }
  static constexpr ShapeGradients<4, 2> gradients(const RefPoint<2>& xi) {
    ShapeGradients<4, 2> dN{};
    for (std::size_t a = 0; a < 4; ++a)
      dN[a] = {0.25 * corners[a][0] * (1 + corners[a][1] * xi[1]),
               0.25 * corners[a][1] * (1 + corners[a][0] * xi[0])};
    return dN;
  }
};

/// Serendipity quadrilateral.
struct Quad8 {
  static constexpr int dim = 2;
  static constexpr int nodes = 8;
  static constexpr std::array<RefPoint<2>, 8> corners{
      {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

  static constexpr ShapeValues<8> values(const RefPoint<2>& xi) {
    ShapeValues<8> N{};
    for (std::size_t a = 0; a < 8; ++a) {
      const double sx = corners[a][0] * xi[0];
      const double sy = corners[a][1] * xi[1];
      if (a < 4)
        N[a] = 0.25 * (1 + sx) * (1 + sy) * (sx + sy - 1);
      else if (corners[a][0] == 0)
        N[a] = 0.5 * (1 - xi[0] * xi[0]) * (1 + sy);
      else
        N[a] = 0.5 * (1 - xi[1] * xi[1]) * (1 + sx);
    }
    return N;
  }
  static constexpr ShapeGradients<8, 2> gradients(const RefPoint<2>& xi) {
    ShapeGradients<8, 2> dN{};
    for (std::size_t a = 0; a < 8; ++a) {
      const double cx = corners[a][0];
      const double cy = corners[a][1];
      const double sx = cx * xi[0];
      const double sy = cy * xi[1];
      if (a < 4)
        dN[a] = {0.25 * cx * (1 + sy) * (2 * sx + sy), 0.25 * cy * (1 + sx) * (2 * sy + sx)};
      else if (cx == 0)
        dN[a] = {-xi[0] * (1 + sy), 0.5 * cy * (1 - xi[0] * xi[0])};
      else
        dN[a] = {0.5 * cx * (1 - xi[1] * xi[1]), -xi[1] * (1 + sx)};
    }
    return dN;
  }
};

/// Trilinear hexahedron.
struct Hex8 {
  static constexpr int dim = 3;
  static constexpr int nodes = 8;
  static constexpr std::array<RefPoint<3>, 8> corners{{{-1, -1, -1},
                                                       {1, -1, -1},
                                                       {1, 1, -1},
                                                       {-1, 1, -1},
                                                       {-1, -1, 1},
                                                       {1, -1, 1},
                                                       {1, 1, 1},
                                                       {-1, 1, 1}}};

  static constexpr ShapeValues<8> values(const RefPoint<3>& xi) {
    ShapeValues<8> N{};
    for (std::size_t a = 0; a < 8; ++a)
      N[a] = 0.125 * (1 + corners[a][0] * xi[0]) * (1 + corners[a][1] * xi[1]) *
             (1 + corners[a][2] * xi[2]);
    return N;
  }
  static constexpr ShapeGradients<8, 3> gradients(const RefPoint<3>& xi) {
    ShapeGradients<8, 3> dN{};
    for (std::size_t a = 0; a < 8; ++a) {
      const double x = 1 + corners[a][0] * xi[0];
      const double y = 1 + corners[a][1] * xi[1];
      const double z = 1 + corners[a][2] * xi[2];
      dN[a] = {0.125 * corners[a][0] * y * z, 0.125 * corners[a][1] * x * z,
               0.125 * corners[a][2] * x * y};
    }
    return dN;
  }
};

/// Serendipity hexahedron.
struct Hex20 {
  static constexpr int dim = 3;
  static constexpr int nodes = 20;
  static constexpr std::array<RefPoint<3>, 20> corners{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
       {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
       {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}}};

  static constexpr ShapeValues<20> values(const RefPoint<3>& xi) {
    ShapeValues<20> N{};
    for (std::size_t a = 0; a < 20; ++a) {
      double product = a < 8 ? 0.125 : 0.25;
      double sum = -2.0;
      for (std::size_t d = 0; d < 3; ++d) {
        product *= factor(corners[a][d], xi[d]);
        sum += corners[a][d] * xi[d];
      }
      N[a] = a < 8 ? product * sum : product;
    }
    return N;
  }
  static constexpr ShapeGradients<20, 3> gradients(const RefPoint<3>& xi) {
    ShapeGradients<20, 3> dN{};
    for (std::size_t a = 0; a < 20; ++a) {
      double sum = -2.0;
      for (std::size_t d = 0; d < 3; ++d)
        sum += corners[a][d] * xi[d];
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t e = (d + 1) % 3;
        const std::size_t f = (d + 2) % 3;
        const double others = factor(corners[a][e], xi[e]) * factor(corners[a][f], xi[f]);
        const double c = corners[a][d];
        if (a < 8)
          dN[a][d] = 0.125 * others * c * (sum + 1 + c * xi[d]);
        else
          dN[a][d] = 0.25 * others * (c == 0 ? -2 * xi[d] : c);
      }
    }
    return dN;
  }

private:
  /// (1 + c x) towards a corner, (1 - x^2) along an edge whose middle the node is.
  static constexpr double factor(double c, double x) { return c == 0 ? 1 - x * x : 1 + c * x; }
};

/// Linear triangle (dim = 2) or tetrahedron (dim = 3): its barycentric coordinates.
template <int dimension> struct LinearSimplex {
  static constexpr int dim = dimension;
  static constexpr int nodes = dim + 1;

  /// Reference coordinates of all nodes.
  static constexpr std::array<RefPoint<dim>, nodes> corners = [] {
    std::array<RefPoint<dim>, nodes> places{};
    for (std::size_t a = 1; a < nodes; ++a)
      places[a][a - 1] = 1.0;
    return places;
  }();

  static constexpr ShapeValues<nodes> values(const RefPoint<dim>& xi) {
    ShapeValues<nodes> N{1.0};
    for (std::size_t d = 0; d < dim; ++d) {
      N[d + 1] = xi[d];
      N[0] -= xi[d];
    }
    return N;
  }
  static constexpr ShapeGradients<nodes, dim> gradients(const RefPoint<dim>&) {
    ShapeGradients<nodes, dim> dN{};
    for (std::size_t d = 0; d < dim; ++d) {
      dN[0][d] = -1.0;
      dN[d + 1][d] = 1.0;
    }
    return dN;
  }
};

/// Quadratic triangle (dim = 2) or tetrahedron (dim = 3) in barycentric coordinates: a node at
/// each of the dim + 1 corners and in the middle of each edge. (M.30)
///
/// @tparam edges  the two corners of each edge, in the order of the middle nodes
template <int dimension, auto edges> struct QuadraticSimplex {
  static constexpr int dim = dimension;
  static constexpr int nodes = (dim + 1) * (dim + 2) / 2;
  static constexpr std::size_t n_corners = dim + 1;

  /// Reference coordinates of all nodes.
  static constexpr std::array<RefPoint<dim>, nodes> corners = [] {
    std::array<RefPoint<dim>, nodes> places{};
    for (std::size_t a = 1; a < n_corners; ++a)
      places[a][a - 1] = 1.0;
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (std::size_t d = 0; d < dim; ++d)
        places[n_corners + e][d] = 0.5 * (places[edges[e][0]][d] + places[edges[e][1]][d]);
    return places;
  }();

  static constexpr ShapeValues<nodes> values(const RefPoint<dim>& xi) {
    const auto lambda = barycentric(xi);
    ShapeValues<nodes> N{};
    for (std::size_t a = 0; a < n_corners; ++a)
      N[a] = lambda[a] * (2 * lambda[a] - 1);
    for (std::size_t e = 0; e < edges.size(); ++e)
      N[n_corners + e] = 4 * lambda[edges[e][0]] * lambda[edges[e][1]];
    return N;
  }
  static constexpr ShapeGradients<nodes, dim> gradients(const RefPoint<dim>& xi) {
    const auto lambda = barycentric(xi);
    ShapeGradients<nodes, dim> dN{};
    for (std::size_t d = 0; d < dim; ++d) {
      for (std::size_t a = 0; a < n_corners; ++a)
        dN[a][d] = (4 * lambda[a] - 1) * slope(a, d);
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::size_t a = edges[e][0];
        const std::size_t b = edges[e][1];
        dN[n_corners + e][d] = 4 * (lambda[a] * slope(b, d) + lambda[b] * slope(a, d));
      }
    }
    return dN;
  }

private:
  static constexpr std::array<double, n_corners> barycentric(const RefPoint<dim>& xi) {
    return LinearSimplex<dim>::values(xi);
  }
  /// d lambda_a / d xi_d.
  static constexpr double slope(std::size_t a, std::size_t d) {
    return LinearSimplex<dim>::gradients({})[a][d];
  }
};

inline constexpr std::array<std::array<std::size_t, 2>, 3> triangle_edges{{{0, 1}, {1, 2}, {2, 0}}};
inline constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

using Tri3 = LinearSimplex<2>;
using Tet4 = LinearSimplex<3>;
using Tri6 = QuadraticSimplex<2, triangle_edges>;
using Tet10 = QuadraticSimplex<3, tetrahedron_edges>;

} // namespace billet::mechanics
