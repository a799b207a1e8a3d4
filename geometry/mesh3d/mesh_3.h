// What CGAL's Mesh_3 needs in both meshers of solids: types, angles to be reached, surfaces as it
// takes them, and the one place where its templates are made, for they take minutes. Internal to
// geometry/: no other header may include it.
//
// Units   mm; angles in degrees.

#pragma once

#include "geometry/triangles/triangle_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Random.h>

#include <array>
#include <cstddef>
#include <vector>

namespace billet::geometry::mesh_3 {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::
    Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Vertex = Triangulation::Vertex_handle;

inline constexpr double facet_angle = 25.0;     ///< smallest on the surface; above 30 may not end
inline constexpr double sliver = 14.0;          ///< dihedral angle to be reached
inline constexpr double radius_over_edge = 2.0; ///< of a tetrahedron; below 2 may not end

inline Kernel::Point_3 to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

inline Vec3 from_cgal(const Vertex& vertex) {
  const auto& x = vertex->point();
  return {CGAL::to_double(x.x()), CGAL::to_double(x.y()), CGAL::to_double(x.z())};
}

/// The facets are in the order of the triangles.
inline Polyhedron polyhedron(const TriangleMesh& surface) {
  std::vector<Kernel::Point_3> points;
  points.reserve(surface.points.size());
  for (const Vec3& p : surface.points)
    points.push_back(to_cgal(p));
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back(
        {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  Polyhedron result;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, result);
  return result;
}

/// Where the refinement starts is drawn at random; the same every time.
inline Domain seeded_domain(const Polyhedron& surface) {
  CGAL::get_default_random() = CGAL::Random(0);
  return Domain(surface, &CGAL::get_default_random());
}

/// Refines from scratch; `too_many` if it would take more vertices than `most`, or if 0, any
/// number.
struct Refined {
  Complex complex;
  bool too_many;
};
[[nodiscard]] Refined refined(const Domain& domain, const Criteria& criteria, std::size_t most);

/// Where refinement does not end edges get ever shorter. [mm]
[[nodiscard]] Vec3 middle_of_shortest_edge(const Triangulation& triangulation);

/// Moves vertices until few tetrahedra have a dihedral angle below that. Exudation, in addition,
/// does not end on some bodies and makes others no better.
void remove_slivers(Complex& complex, const Domain& domain, double angle = sliver);

} // namespace billet::geometry::mesh_3
