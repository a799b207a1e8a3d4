#include "geometry/mesher_3d.h"

#include "geometry/base/error.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Random.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

namespace billet::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::
    Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double most_tetrahedra = 5e6;
constexpr double facet_angle = 25.0; ///< smallest on the surface [degrees]; above 30 may not end
constexpr double sag = 0.03;         ///< of a facet off the surface, over the size
constexpr double radius_over_edge = 2.0; ///< of a tetrahedron; below 2 may not end
constexpr double sliver = 14.0;          ///< dihedral angle to be reached [degrees]

Polyhedron polyhedron(const TriangleMesh& surface) {
  std::vector<Kernel::Point_3> points;
  points.reserve(surface.points.size());
  for (const Vec3& p : surface.points)
    points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back(
        {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  Polyhedron result;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, result);
  return result;
}

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

SolidMesh extracted(const Complex& complex) {
  SolidMesh mesh;
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    std::array<std::int32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto vertex = cell->vertex(static_cast<int>(i));
      const auto [place, is_new] =
          number.try_emplace(vertex, static_cast<std::int32_t>(mesh.points.size()));
      if (is_new)
        mesh.points.emplace_back(CGAL::to_double(vertex->point().x()),
                                 CGAL::to_double(vertex->point().y()),
                                 CGAL::to_double(vertex->point().z()));
      corners[i] = place->second;
    }
    mesh.tetrahedra.push_back(corners);
  }
  return mesh;
}

const Vec3& corner(const SolidMesh& mesh, const std::array<std::int32_t, 4>& cell, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(cell[i])];
}

} // namespace

SolidMesh mesh_solid(const TriangleMesh& surface, double size, double feature_angle) {
  require_sound(surface, size);
  // Where the refinement starts is drawn at random; the same every time.
  CGAL::get_default_random() = CGAL::Random(0);
  Domain domain(polyhedron(surface), &CGAL::get_default_random());
  domain.detect_features(feature_angle);
  namespace with = CGAL::parameters;
  const Criteria criteria(with::edge_size = size, with::facet_angle = facet_angle,
                          with::facet_size = size, with::facet_distance = sag * size,
                          with::cell_radius_edge_ratio = radius_over_edge, with::cell_size = size);
  auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, with::no_perturb(), with::no_exude());
  CGAL::perturb_mesh_3(complex, domain, with::sliver_bound = sliver);
  CGAL::exude_mesh_3(complex, with::sliver_bound = sliver);
  SolidMesh mesh = extracted(complex);
  if (mesh.tetrahedra.empty())
    throw Error(Fault::geometry, "", "the body could not be meshed",
                "give a size smaller than its thinnest wall");
  return mesh;
}

double smallest_dihedral(const SolidMesh& mesh) {
  double least = std::numbers::pi;
  for (const auto& cell : mesh.tetrahedra) {
    std::array<Vec3, 4> normals; // of the face opposite to each corner, inward
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& a = corner(mesh, cell, (i + 1) % 4);
      Vec3 n = (corner(mesh, cell, (i + 2) % 4) - a).cross(corner(mesh, cell, (i + 3) % 4) - a);
      normals[i] = n.dot(corner(mesh, cell, i) - a) > 0.0 ? n : Vec3(-n);
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        least = std::min(least, std::numbers::pi - std::atan2(normals[i].cross(normals[j]).norm(),
                                                              normals[i].dot(normals[j])));
  }
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
