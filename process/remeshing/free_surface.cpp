#include "process/remeshing/free_surface.h"

#include <algorithm>
#include <cmath>

namespace billet::process {

namespace {

/// Outward, as long as the face or twice the area of half of it.
Vec3 normal_of(std::span<const double> x, int dim, const mechanics::Face& face) {
  const Vec3 first = mechanics::node_position(x, dim, face.nodes[0]);
  const Vec3 along = mechanics::node_position(x, dim, face.nodes[1]) - first;
  if (dim == 2)
    return {along.y(), -along.x(), 0.0};
  return along.cross(mechanics::node_position(x, dim, face.nodes[2]) - first);
}

} // namespace

std::vector<double>
free_normals(const Part& part, std::span<const double> x, std::span<const char> touching) {
  const int dim = part.mesh.dimension();
  const Index n_nodes = part.mesh.n_points();
  std::vector<double> normals(idx(dim * n_nodes), 0.0);
  std::vector<char> touched(idx(n_nodes), 0);
  for (std::size_t f = 0; f < part.contact_faces.size(); ++f) {
    const mechanics::Face& face = part.contact_faces[f];
    const Vec3 normal = normal_of(x, dim, face);
    for (const Index node : face.nodes) {
      touched[idx(node)] = static_cast<char>(touched[idx(node)] != 0 || touching[f] != 0);
      for (int i = 0; i < dim; ++i)
        normals[idx(dim * node + i)] += normal[i];
    }
  }
  for (Index node = 0; node < n_nodes; ++node) {
    const std::span<double> normal(normals.data() + idx(dim * node), idx(dim));
    double square = 0.0;
    for (const double n : normal)
      square += n * n;
    const double factor = touched[idx(node)] == 0 && square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    for (double& n : normal)
      n *= factor;
    if (part.analysis == mechanics::Analysis::axisymmetric && x[idx(dim * node)] == 0.0)
      normal[0] = 0.0;
  }
  for (const Support& support : part.supports)
    for (const Index node : support.nodes)
      normals[idx(dim * node + support.component)] = 0.0;
  return normals;
}

void restore_volume(std::vector<double>& x,
                    std::span<const double> normals,
                    const std::function<double(std::span<const double>)>& volume,
                    double wanted,
                    double furthest) {
  const std::vector<double> from = x;
  const auto volume_at = [&](double way) {
    for (std::size_t i = 0; i < normals.size(); ++i)
      x[i] = from[i] + way * normals[i];
    return volume(std::span(x).first(normals.size()));
  };
  constexpr double first_try = 0.01; // of the furthest: short enough for a straight line
  const double before = volume_at(0.0);
  const double growth = (volume_at(first_try * furthest) - before) / (first_try * furthest);
  const double way = growth > 0.0 ? (wanted - before) / growth : 0.0;
  volume_at(std::clamp(way, -furthest, furthest));
}

} // namespace billet::process
