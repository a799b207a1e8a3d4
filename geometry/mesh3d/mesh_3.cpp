#include "geometry/mesh3d/mesh_3.h"

#include <CGAL/Mesh_error_code.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <limits>

namespace billet::geometry::mesh_3 {

Refined refined(const Domain& domain, const Criteria& criteria, std::size_t most) {
  namespace with = CGAL::parameters;
  CGAL::Mesh_error_code code = CGAL::CGAL_MESH_3_NO_ERROR;
  with::internal::Mesh_3_options options;
  options.maximal_number_of_vertices = most;
  options.pointer_to_error_code = &code;
  Refined result{
      CGAL::make_mesh_3<Complex>(domain, criteria, with::no_perturb(), with::no_exude(), options),
      false};
  result.too_many = code != CGAL::CGAL_MESH_3_NO_ERROR;
  return result;
}

void remove_slivers(Complex& complex, const Domain& domain, double angle) {
  CGAL::perturb_mesh_3(complex, domain, CGAL::parameters::sliver_bound = angle);
}

Vec3 middle_of_shortest_edge(const Triangulation& triangulation) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 middle = Vec3::Zero();
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    const Vec3 a = from_cgal(edge->first->vertex(edge->second)),
               b = from_cgal(edge->first->vertex(edge->third));
    if ((b - a).squaredNorm() < least) {
      least = (b - a).squaredNorm();
      middle = 0.5 * (a + b);
    }
  }
  return middle;
}

} // namespace billet::geometry::mesh_3
