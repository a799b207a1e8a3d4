#include "mechanics/elements/elements.h"
#include "mechanics/elements/mesh_locator.h"
#include "tests/support/figures.h"
#include "tests/support/tensors.h"
#include "tests/support/transfer_meshes.h"

#include <gtest/gtest.h>

namespace billet::mechanics::mesh_locator_test {
namespace {

using support::transfer_kinds;

Mesh distorted(ElementKind kind) { return support::shifted_strip(kind, 5, 3, 0.4, 0.12); }

TEST(MeshLocator, finds_the_place_of_a_point_in_distorted_cells) {
  constexpr double tolerance = 1e-13; // of cells of size 1 some units from the origin
  for (const ElementKind kind : transfer_kinds) {
    const Mesh mesh = distorted(kind);
    const std::vector<double> x = node_positions(mesh);
    const MeshLocator locator(mesh, x);
    const std::vector<Vec3> points = integration_points(mesh, x);
    const std::vector<MeshLocation> places = locator.locate(points);
    const int per_element = points_per_element(kind);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(places[i].element, static_cast<Index>(i) / per_element);
      Vec3 again = Vec3::Zero();
      std::vector<double> nodal;
      for (const Vec3& p : mesh.points)
        nodal.insert(nodal.end(), p.data(), p.data() + 3);
      interpolate(mesh, places[i], nodal, {again.data(), 3});
      worst = std::max({worst, (again - points[i]).norm(), places[i].distance});
    }
    support::show_error("locator", std::string(name(kind)), worst, tolerance);
    EXPECT_LE(worst, tolerance) << name(kind);
  }
}

TEST(MeshLocator, of_elements_that_share_a_face_the_lowest_is_named) {
  for (const ElementKind kind : transfer_kinds) {
    const Mesh mesh = distorted(kind);
    const std::vector<double> x = node_positions(mesh);
    const MeshLocator locator(mesh, x);
    for (Index node = 0; node < mesh.n_points(); ++node) {
      Index lowest = mesh.n_elements();
      for (Index e = mesh.n_elements() - 1; e >= 0; --e)
        for (const Index a : mesh.cell(e))
          lowest = a == node ? e : lowest;
      const auto place = locator.locate(mesh.points[static_cast<std::size_t>(node)]);
      EXPECT_EQ(place.element, lowest) << name(kind) << " node " << node;
    }
  }
}

/// Smallest distance of a point from a fine grid of places in all elements.
double sampled_distance(const Mesh& mesh, const Vec3& point) {
  return visit_element(mesh.kind, [&](auto kind) {
    using Shape = typename decltype(kind)::Shape;
    constexpr int dim = Shape::dim;
    constexpr int n = 24;
    const bool simplex = Shape::nodes == (dim + 1) * (dim + 2) / 2;
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < (dim == 2 ? n * n : n * n * n); ++k) {
      RefPoint<dim> xi{};
      double sum = 0.0;
      for (int d = 0, rest = k; d < dim; ++d, rest /= n) {
        const double at = static_cast<double>(rest % n) / (n - 1);
        xi[static_cast<std::size_t>(d)] = simplex ? at : 2.0 * at - 1.0;
        sum += at;
      }
      if (simplex && sum > 1.0 + 1e-12)
        continue;
      const auto N = Shape::values(xi);
      for (Index e = 0; e < mesh.n_elements(); ++e) {
        Vec3 p = -point;
        for (std::size_t a = 0; a < N.size(); ++a)
          p += N[a] * mesh.points[static_cast<std::size_t>(mesh.cell(e)[a])];
        best = std::min(best, p.norm());
      }
    }
    return best;
  });
}

TEST(MeshLocator, a_point_outside_gets_the_nearest_place) {
  for (const ElementKind kind : transfer_kinds) {
    const bool solid = dimension(kind) == 3;
    const Mesh mesh = support::shifted_strip(kind, 2, 2, 0.0, 0.1);
    const std::vector<double> x = node_positions(mesh);
    const MeshLocator locator(mesh, x);
    support::Random random(5);
    for (int trial = 0; trial < (solid ? 10 : 100); ++trial) {
      Vec3 point = Vec3(1, 1, 1) + random.vector(2.0);
      point[2] = solid ? point[2] : 0.0;
      const double sampled = sampled_distance(mesh, point);
      const MeshLocation place = locator.locate(point);
      constexpr double spacing = 1.8 / 23.0; // of the samples, across their squares
      EXPECT_LE(place.distance, sampled + 1e-12) << name(kind);
      EXPECT_GE(place.distance, sampled - spacing) << name(kind);
      for (int d = 0; d < dimension(kind); ++d)
        EXPECT_LE(std::abs(place.xi[d]), 1.0 + 1e-9);
    }
  }
}

TEST(MeshLocator, places_do_not_depend_on_the_unit_of_length) {
  for (const ElementKind kind : transfer_kinds) {
    Mesh mesh = distorted(kind);
    std::vector<double> x = node_positions(mesh);
    std::vector<Vec3> points = integration_points(mesh, x);
    points.emplace_back(-0.3, 1.2, dimension(kind) == 3 ? 0.4 : 0.0);
    const std::vector<MeshLocation> places = MeshLocator(mesh, x).locate(points);
    for (const double unit : {0x1p-30, 0x1p30}) {
      std::vector<double> scaled = x;
      for (double& value : scaled)
        value *= unit;
      std::vector<Vec3> there = points;
      for (Vec3& p : there)
        p *= unit;
      const std::vector<MeshLocation> same = MeshLocator(mesh, scaled).locate(there);
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(same[i].element, places[i].element);
        EXPECT_EQ(same[i].xi, places[i].xi);
      }
    }
  }
}

} // namespace
} // namespace billet::mechanics::mesh_locator_test
