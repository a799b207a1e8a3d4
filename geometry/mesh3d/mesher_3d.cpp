#include "geometry/mesh3d/mesher_3d.h"

#include "geometry/base/error.h"
#include "geometry/mesh3d/mesh_3.h"
#include "geometry/mesh3d/solid_quality.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/sharp_edges.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

constexpr double wanted_quality = 0.3; ///< `shape_quality`, as far as that is possible

/// Smallest angle of facets where details are not followed: sharp edges that are not kept could ask
/// for larger ones without end.
constexpr double angle_with_details = 10.0;

/// Dihedral angle to be reached there: more takes minutes next to edges that are not kept.
constexpr double sliver_with_details = 5.0;

/// Of the volume, that a mesh may lose or win.
constexpr double most_volume_change = 0.1;

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
}

/// Vertices beyond which refinement is taken to have no end: the estimate is right to a factor of
/// two or so.
std::size_t most_vertices(const SolidEstimate& estimate) {
  constexpr double over_estimate = 4.0, besides = 2e4, tetrahedra_a_vertex = 3.0;
  return static_cast<std::size_t>((over_estimate * estimate.tetrahedra() + besides) /
                                  tetrahedra_a_vertex);
}

[[noreturn]] void refuse_endless(const mesh_3::Triangulation& triangulation, double size) {
  const Vec3 x = mesh_3::middle_of_shortest_edge(triangulation);
  throw Error(Fault::limit, "",
              fmt::format("tetrahedra of size {:.6g} with good angles need more than {} nodes in "
                          "this body, the smallest near ({:.6g}, {:.6g}, {:.6g})",
                          size, triangulation.number_of_vertices(), x.x(), x.y(), x.z()),
              "pass over small shapes with details = ..., or leave them out of the file");
}

void add_lines(mesh_3::Domain& domain, const std::vector<std::vector<Vec3>>& lines) {
  std::vector<std::vector<mesh_3::Kernel::Point_3>> all;
  for (const std::vector<Vec3>& line : lines) {
    auto& points = all.emplace_back();
    for (const Vec3& x : line)
      points.push_back(mesh_3::to_cgal(x));
  }
  domain.add_features(all.begin(), all.end());
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

void require_volume(const SolidMesh& mesh,
                    const TriangleMesh& surface,
                    const SolidRefinement& wanted) {
  const double change = volume(mesh) / health(surface).volume - 1.0;
  if (std::abs(change) > most_volume_change)
    throw Error(
        Fault::geometry, "",
        fmt::format("the mesh of size {:.6g} has a volume {:+.1f} % off that of the surface: "
                    "thin places were lost",
                    wanted.size, 100.0 * change),
        wanted.details > 0.0 ? "give a smaller value of details, or a smaller size"
                             : "give a smaller size");
}

} // namespace

SolidMesh mesh_solid(const TriangleMesh& surface, const SolidRefinement& wanted) {
  require_sound(surface, wanted.size);
  return mesh_solid(surface, wanted, solid_estimate(surface, wanted));
}

SolidMesh mesh_solid(const TriangleMesh& surface,
                     const SolidRefinement& wanted,
                     const SolidEstimate& estimate) {
  require_sound(surface, wanted.size);
  require_meshable(estimate, wanted);
  mesh_3::Domain domain = mesh_3::seeded_domain(mesh_3::polyhedron(surface));
  if (wanted.details > 0.0)
    add_lines(domain, lines_without_details(surface, wanted.feature_angle, wanted.details));
  else
    domain.detect_features(wanted.feature_angle);
  namespace with = CGAL::parameters;
  const mesh_3::Criteria criteria(
      with::edge_size = wanted.size,
      with::facet_angle = wanted.details > 0.0 ? angle_with_details : mesh_3::facet_angle,
      with::facet_size = wanted.size, with::facet_distance = wanted.distance(),
      with::cell_radius_edge_ratio = mesh_3::radius_over_edge, with::cell_size = wanted.size);
  mesh_3::Refined refined = mesh_3::refined(domain, criteria, most_vertices(estimate));
  if (refined.too_many)
    refuse_endless(refined.complex.triangulation(), wanted.size);
  mesh_3::remove_slivers(refined.complex, domain,
                         wanted.details > 0.0 ? sliver_with_details : mesh_3::sliver);
  SolidMesh mesh = extracted(refined.complex);
  if (mesh.tetrahedra.empty())
    throw Error(Fault::geometry, "", "the body could not be meshed",
                "give a size smaller than its thinnest wall");
  require_volume(mesh, surface, wanted);
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
