#include "mechanics/transfer/rate_gradient.h"

#include "mechanics/bulk/element_rings.h"

#include <Eigen/Eigenvalues>

#include <cstddef>
#include <limits>

namespace billet::mechanics {

namespace {

/// Sum of squares over the sum: the mean over the work that the flow does.
double mean_over_flow(std::span<const double> rate, std::span<const double> volumes) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < rate.size(); ++k) {
    sum += volumes[k] * rate[k];
    squares += volumes[k] * rate[k] * rate[k];
  }
  return sum > 0.0 ? squares / sum : 0.0;
}

/// The straight line through values at scattered points, by least squares; along directions in
/// which they do not scatter it is level.
Vec3 gradient_of(std::span<const Vec3> positions, std::span<const double> values) {
  const auto n = static_cast<double>(positions.size());
  Vec3 middle = Vec3::Zero();
  double mean = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    middle += positions[i] / n;
    mean += values[i] / n;
  }
  Mat3 scatter = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 offset = positions[i] - middle;
    scatter += offset * offset.transpose();
    moment += (values[i] - mean) * offset;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(scatter);
  constexpr double none = 1e-10;
  Vec3 gradient = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (axes.eigenvalues()[i] > none * axes.eigenvalues()[2])
      gradient += axes.eigenvectors().col(i).dot(moment) / axes.eigenvalues()[i] *
                  axes.eigenvectors().col(i);
  return gradient;
}

} // namespace

std::vector<RateGradient> rate_gradients(const Mesh& mesh,
                                         std::span<const Vec3> positions,
                                         std::span<const double> rate,
                                         std::span<const double> volumes) {
  const double mean = mean_over_flow(rate, volumes);
  if (!(mean > 0.0))
    return {};
  const auto n = rate.size() / idx(mesh.n_elements());
  const ElementRings rings(mesh);
  std::vector<RateGradient> result;
  std::vector<Vec3> near;
  std::vector<double> values;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    near.clear();
    values.clear();
    for (const Index neighbour : rings.first(e))
      for (std::size_t k = idx(neighbour) * n; k < (idx(neighbour) + 1) * n; ++k) {
        near.push_back(positions[k]);
        values.push_back(rate[k]);
      }
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = idx(e) * n; k < (idx(e) + 1) * n; ++k)
      middle += positions[k] / static_cast<double>(n);
    const double steepness = gradient_of(near, values).norm();
    result.push_back(
        {middle, steepness > 0.0 ? mean / steepness : std::numeric_limits<double>::infinity()});
  }
  return result;
}

} // namespace billet::mechanics
