#include "process/state/mesh_quality.h"

#include "geometry/base/pieces.h"
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
  constexpr std::size_t elements_at_once = 256;
  const double measure = sum_of_pieces(idx(mesh.n_elements()), elements_at_once,
                                       [&](std::size_t begin, std::size_t end) {
                                         double part = 0.0;
                                         std::vector<Vec3> points;
                                         for (std::size_t e = begin; e < end; ++e) {
                                           points.clear();
                                           for (const Index node : mesh.cell(static_cast<Index>(e)))
                                             points.push_back(mesh.points[idx(node)]);
                                           part += mechanics::element_measure(mesh.kind, points);
                                         }
                                         return part;
                                       });
  const bool plane = mesh.dimension() == 2;
  const double of_simplex = plane ? std::numbers::sqrt3 / 4.0 : 1.0 / (6.0 * std::numbers::sqrt2);
  const double share = mechanics::is_simplex(mesh.kind) ? of_simplex : 1.0;
  const double mean = measure / (share * mesh.n_elements());
  return plane ? std::sqrt(mean) : std::cbrt(mean);
}

} // namespace billet::process
