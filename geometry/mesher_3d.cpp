#include "geometry/mesher_3d.h"

#include "geometry/base/error.h"
#include "geometry/mesh_3.h"
#include "geometry/solid_quality.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

namespace billet::geometry {

namespace {

constexpr double most_tetrahedra = 5e6;
constexpr double wanted_quality = 0.3; ///< `shape_quality`, as far as that is possible
constexpr double sag = 0.03;           ///< of a facet off the surface, over the size

void require_sound(const TriangleMesh& surface, double size) {
  if (!(size > 0.0) || !std::isfinite(size))
    throw Error(Fault::geometry, "", fmt::format("the size of tetrahedra is {}", size),
                "give a positive size");
  const MeshHealth state = health(surface);
  if (!state.closed())
    throw Error(Fault::geometry, "", "the surface of a body must be closed",
                "close its holes; an open surface can only be a tool");
  if (state.inside_out())
    throw Error(Fault::geometry, "", "the surface of the body is inside out");
  // A regular tetrahedron of that side.
  const double expected = state.volume / (std::pow(size, 3) / (6.0 * std::numbers::sqrt2));
  if (!(expected < most_tetrahedra))
    throw Error(Fault::limit, "",
                fmt::format("tetrahedra of size {} would be about {:.3g}; at most {:.0e} are made",
                            size, expected, most_tetrahedra),
                "give a larger size");
}

SolidMesh extracted(const mesh_3::Complex& complex) {
  SolidMesh mesh;
  std::map<mesh_3::Vertex, std::int32_t> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    std::array<std::int32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto vertex = cell->vertex(static_cast<int>(i));
      const auto [place, is_new] =
          number.try_emplace(vertex, static_cast<std::int32_t>(mesh.points.size()));
      if (is_new)
        mesh.points.push_back(mesh_3::from_cgal(vertex));
      corners[i] = place->second;
    }
    mesh.tetrahedra.push_back(corners);
  }
  return mesh;
}

/// Flags of the nodes that are on no face of a single tetrahedron.
std::vector<char> nodes_inside(const SolidMesh& mesh) {
  std::map<std::array<std::int32_t, 3>, int> uses;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    for (std::array<std::int32_t, 3> face :
         {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) {
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  std::vector<char> inside(mesh.points.size(), 1);
  for (const auto& [face, times] : uses)
    if (times == 1)
      for (const std::int32_t node : face)
        inside[static_cast<std::size_t>(node)] = 0;
  return inside;
}

const Vec3& corner(const SolidMesh& mesh, const std::array<std::int32_t, 4>& cell, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(cell[i])];
}

} // namespace

SolidMesh mesh_solid(const TriangleMesh& surface, double size, double feature_angle) {
  require_sound(surface, size);
  mesh_3::Domain domain = mesh_3::seeded_domain(mesh_3::polyhedron(surface));
  domain.detect_features(feature_angle);
  namespace with = CGAL::parameters;
  const mesh_3::Criteria criteria(with::edge_size = size, with::facet_angle = mesh_3::facet_angle,
                                  with::facet_size = size, with::facet_distance = sag * size,
                                  with::cell_radius_edge_ratio = mesh_3::radius_over_edge,
                                  with::cell_size = size);
  mesh_3::Refined refined = mesh_3::refined(domain, criteria, 0);
  mesh_3::remove_slivers(refined.complex, domain);
  SolidMesh mesh = extracted(refined.complex);
  if (mesh.tetrahedra.empty())
    throw Error(Fault::geometry, "", "the body could not be meshed",
                "give a size smaller than its thinnest wall");
  improve(
      mesh, nodes_inside(mesh), [](std::int32_t, const Vec3& x) { return x; }, wanted_quality);
  return mesh;
}

double smallest_dihedral(const SolidMesh& mesh) {
  double least = std::numbers::pi;
  for (const auto& cell : mesh.tetrahedra)
    least = std::min(least, smallest_dihedral({corner(mesh, cell, 0), corner(mesh, cell, 1),
                                               corner(mesh, cell, 2), corner(mesh, cell, 3)}));
  return least * 180.0 / std::numbers::pi;
}

double volume(const SolidMesh& mesh) {
  double sum = 0.0;
  for (const auto& cell : mesh.tetrahedra) {
    const Vec3& a = corner(mesh, cell, 0);
    sum += (corner(mesh, cell, 1) - a)
               .cross(corner(mesh, cell, 2) - a)
               .dot(corner(mesh, cell, 3) - a) /
           6.0;
  }
  return sum;
}

} // namespace billet::geometry
