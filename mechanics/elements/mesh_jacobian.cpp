#include "mechanics/elements/mesh_jacobian.h"

#include "mechanics/mesh/mesh_edges.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace billet::mechanics {

namespace {

constexpr int max_nodes = 20;
using Gradients = std::array<Vec3, max_nodes>;

const std::array<Vec3, 4> quad_corners{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0),
                                       Vec3(-1, 1, 0)};
const std::array<Vec3, 8> hex_corners{Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1),
                                      Vec3(-1, 1, -1),  Vec3(-1, -1, 1), Vec3(1, -1, 1),
                                      Vec3(1, 1, 1),    Vec3(-1, 1, 1)};
const std::array<Vec3, 4> simplex_corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                          Vec3(0, 0, 1)};

/// Gradient of the product of (1 + a_k) over the axes, a_k = xi_k * corner_k.
Vec3 product_gradient(const Vec3& one_plus, const Vec3& corner, Eigen::Index dimension) {
  Vec3 gradient = Vec3::Zero();
  for (Eigen::Index k = 0; k < dimension; ++k) {
    gradient[k] = corner[k];
    for (Eigen::Index other = 0; other < dimension; ++other)
      if (other != k)
        gradient[k] *= one_plus[other];
  }
  return gradient;
}

/// Gradient of a corner's shape function of a serendipity cell.
Vec3 serendipity_corner(const Vec3& xi, const Vec3& corner, Eigen::Index dimension) {
  const Vec3 a = xi.cwiseProduct(corner);
  const Vec3 one_plus = a + Vec3::Ones();
  const double scale = dimension == 2 ? 0.25 : 0.125;
  double product = 1.0;
  double sum = 1.0 - static_cast<double>(dimension);
  for (Eigen::Index k = 0; k < dimension; ++k) {
    product *= one_plus[k];
    sum += a[k];
  }
  return scale * (sum * product_gradient(one_plus, corner, dimension) + product * corner);
}

/// Gradient of the shape function of a serendipity cell's mid-side node: the place has one
/// coordinate 0, along its edge.
Vec3 serendipity_middle(const Vec3& xi, const Vec3& place, Eigen::Index dimension) {
  Vec3 factor = Vec3::Ones();
  Vec3 slope = Vec3::Zero();
  for (Eigen::Index k = 0; k < dimension; ++k) {
    const bool along = place[k] == 0.0;
    factor[k] = along ? 1.0 - xi[k] * xi[k] : 0.5 * (1.0 + xi[k] * place[k]);
    slope[k] = along ? -2.0 * xi[k] : 0.5 * place[k];
  }
  return {slope[0] * factor[1] * factor[2], factor[0] * slope[1] * factor[2],
          factor[0] * factor[1] * slope[2]};
}

void brick_gradients(ElementKind kind, const Vec3& xi, Gradients& gradients) {
  const std::span<const Vec3> corners = reference_corners(kind);
  const Eigen::Index dimension = mechanics::dimension(kind);
  const double scale = dimension == 2 ? 0.25 : 0.125;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 one_plus = xi.cwiseProduct(corners[i]) + Vec3::Ones();
    gradients[i] = is_quadratic(kind) ? serendipity_corner(xi, corners[i], dimension)
                                      : scale * product_gradient(one_plus, corners[i], dimension);
  }
  if (!is_quadratic(kind))
    return;
  std::size_t node = corners.size();
  for (const auto& [a, b] : element_edges(kind)) {
    const Vec3 place =
        0.5 * (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]);
    gradients[node++] = serendipity_middle(xi, place, dimension);
  }
}

void simplex_gradients(ElementKind kind, const Vec3& xi, Gradients& gradients) {
  const auto n_corners = static_cast<std::size_t>(corners_per_element(kind));
  std::array<double, 4> lambda{1.0, xi[0], xi[1], xi[2]};
  std::array<Vec3, 4> slope{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::size_t i = 1; i < n_corners; ++i) {
    lambda[0] -= lambda[i];
    slope[0] -= slope[i];
  }
  for (std::size_t i = 0; i < n_corners; ++i)
    gradients[i] = is_quadratic(kind) ? Vec3((4.0 * lambda[i] - 1.0) * slope[i]) : slope[i];
  if (!is_quadratic(kind))
    return;
  std::size_t node = n_corners;
  for (const auto& edge : element_edges(kind)) {
    const auto a = static_cast<std::size_t>(edge[0]);
    const auto b = static_cast<std::size_t>(edge[1]);
    gradients[node++] = 4.0 * (lambda[a] * slope[b] + lambda[b] * slope[a]);
  }
}

Gradients gradients_at(ElementKind kind, const Vec3& xi) {
  Gradients gradients;
  if (is_simplex(kind))
    simplex_gradients(kind, xi, gradients);
  else
    brick_gradients(kind, xi, gradients);
  return gradients;
}

/// Gauss points: 2 an axis for straight cells, 3 for quadratic ones.
std::vector<Sample> brick_samples(int dimension, bool quadratic) {
  const double far = quadratic ? std::sqrt(0.6) : std::sqrt(1.0 / 3.0);
  std::vector<std::pair<double, double>> line{{-far, 1.0}, {far, 1.0}};
  if (quadratic)
    line = {{-far, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {far, 5.0 / 9.0}};
  std::vector<std::pair<double, double>> depth{{0.0, 1.0}};
  if (dimension == 3)
    depth = line;
  std::vector<Sample> samples;
  for (const auto& [z, wz] : depth)
    for (const auto& [y, wy] : line)
      for (const auto& [x, wx] : line)
        samples.push_back({Vec3(x, y, z), wx * wy * wz});
  return samples;
}

/// Degree 2 on the triangle (3 points), degree 3 on the tetrahedron (5 points): those of the
/// determinant there.
std::vector<Sample> simplex_samples(int dimension) {
  constexpr double sixth = 1.0 / 6.0;
  if (dimension == 2)
    return {{Vec3(sixth, sixth, 0), sixth},
            {Vec3(4 * sixth, sixth, 0), sixth},
            {Vec3(sixth, 4 * sixth, 0), sixth}};
  constexpr double outer = 9.0 / 120.0;
  return {{Vec3(0.25, 0.25, 0.25), -16.0 / 120.0},
          {Vec3(sixth, sixth, sixth), outer},
          {Vec3(0.5, sixth, sixth), outer},
          {Vec3(sixth, 0.5, sixth), outer},
          {Vec3(sixth, sixth, 0.5), outer}};
}

} // namespace

std::span<const Vec3> reference_corners(ElementKind kind) {
  if (is_simplex(kind))
    return std::span(simplex_corners).first(static_cast<std::size_t>(corners_per_element(kind)));
  if (dimension(kind) == 2)
    return quad_corners;
  return hex_corners;
}

std::span<const Sample> measuring_points(ElementKind kind) {
  static const std::vector<Sample> triangle = simplex_samples(2);
  static const std::vector<Sample> tetrahedron = simplex_samples(3);
  static const std::array<std::vector<Sample>, 2> quad{brick_samples(2, false),
                                                       brick_samples(2, true)};
  static const std::array<std::vector<Sample>, 2> hexahedron{brick_samples(3, false),
                                                             brick_samples(3, true)};
  if (is_simplex(kind))
    return dimension(kind) == 2 ? triangle : tetrahedron;
  const std::size_t order = is_quadratic(kind) ? 1 : 0;
  return dimension(kind) == 2 ? quad[order] : hexahedron[order];
}

std::vector<Vec3> shape_gradients(ElementKind kind, const Vec3& xi) {
  const Gradients gradients = gradients_at(kind, xi);
  return {gradients.begin(), gradients.begin() + nodes_per_element(kind)};
}

Mat3 jacobian(ElementKind kind, std::span<const Vec3> points, const Vec3& xi) {
  const Gradients gradients = gradients_at(kind, xi);
  Mat3 J = Mat3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    J += points[i] * gradients[i].transpose();
  if (dimension(kind) == 2)
    J.col(2) = Vec3::UnitZ();
  return J;
}

} // namespace billet::mechanics
