#include "mechanics/elements/mesh_jacobian.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace billet::mechanics::mesh_jacobian_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                               ElementKind::tet10};

/// Nodes of the reference cell itself.
std::vector<Vec3> reference_nodes(ElementKind kind) {
  const auto corners = reference_corners(kind);
  std::vector<Vec3> nodes(corners.begin(), corners.end());
  if (is_quadratic(kind))
    for (const auto& [a, b] : element_edges(kind))
      nodes.emplace_back(
          0.5 * (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]));
  return nodes;
}

TEST(MeshJacobian, of_the_reference_cell_is_one_everywhere) {
  for (const ElementKind kind : all_kinds)
    for (const Sample& sample : measuring_points(kind))
      EXPECT_LT((jacobian(kind, reference_nodes(kind), sample.xi) - Mat3::Identity()).norm(), 1e-14)
          << name(kind);
}

TEST(MeshJacobian, of_a_quadratic_map_is_its_exact_gradient) {
  // x -> x + Q(x), a polynomial of degree two that all quadratic kinds hold exactly
  const auto map = [](const Vec3& x) {
    return Vec3(x.x() + 0.1 * x.x() * x.y(), x.y() + 0.2 * x.x() * x.x() - 0.1 * x.y() * x.y(),
                x.z() + 0.3 * x.y() * x.z());
  };
  const auto gradient = [](const Vec3& x) {
    Mat3 J;
    J << 1 + 0.1 * x.y(), 0.1 * x.x(), 0, 0.4 * x.x(), 1 - 0.2 * x.y(), 0, 0, 0.3 * x.z(),
        1 + 0.3 * x.y();
    return J;
  };
  for (const ElementKind kind :
       {ElementKind::quad8, ElementKind::tri6, ElementKind::hex20, ElementKind::tet10}) {
    std::vector<Vec3> nodes = reference_nodes(kind);
    for (Vec3& node : nodes)
      node = map(node);
    for (const Sample& sample : measuring_points(kind)) {
      Mat3 expected = gradient(sample.xi);
      if (dimension(kind) == 2)
        expected.col(2) = Vec3::UnitZ();
      EXPECT_LT((jacobian(kind, nodes, sample.xi) - expected).norm(), 1e-14) << name(kind);
    }
  }
}

TEST(MeshJacobian, weights_add_up_to_the_volume_of_the_reference_cell) {
  constexpr std::array volumes{4.0, 4.0, 0.5, 8.0, 8.0, 1.0 / 6.0, 1.0 / 6.0};
  for (const ElementKind kind : all_kinds) {
    double sum = 0.0;
    for (const Sample& sample : measuring_points(kind))
      sum += sample.weight;
    EXPECT_NEAR(sum, volumes[static_cast<std::size_t>(kind)], 1e-14) << name(kind);
  }
}

} // namespace
} // namespace billet::mechanics::mesh_jacobian_test
