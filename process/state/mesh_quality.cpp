#include "process/state/mesh_quality.h"

#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace billet::process {

using mechanics::Index;

std::vector<Vec3> as_points(std::span<const double> x, int dim) {
  std::vector<Vec3> points(x.size() / idx(dim), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i)
    points[i / idx(dim)][static_cast<Index>(i % idx(dim))] = x[i];
  return points;
}

double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x) {
  const std::vector<double> all =
      mechanics::element_qualities(mesh, as_points(x, mesh.dimension()));
  return *std::min_element(all.begin(), all.end());
}

double mean_side(const mechanics::Mesh& mesh) {
  double measure = 0.0;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Vec3> points;
    for (const Index node : mesh.cell(e))
      points.push_back(mesh.points[idx(node)]);
    measure += mechanics::element_measure(mesh.kind, points);
  }
  const bool plane = mesh.dimension() == 2;
  const double of_simplex = plane ? std::numbers::sqrt3 / 4.0 : 1.0 / (6.0 * std::numbers::sqrt2);
  const double share = mechanics::is_simplex(mesh.kind) ? of_simplex : 1.0;
  const double mean = measure / (share * mesh.n_elements());
  return plane ? std::sqrt(mean) : std::cbrt(mean);
}

} // namespace billet::process
