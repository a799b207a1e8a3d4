#include "geometry/mesh_3.h"

#include <CGAL/Mesh_error_code.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

namespace billet::geometry::mesh_3 {

namespace {

constexpr double sliver = 14.0; ///< dihedral angle to be reached [degrees]

} // namespace

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

void remove_slivers(Complex& complex, const Domain& domain) {
  CGAL::perturb_mesh_3(complex, domain, CGAL::parameters::sliver_bound = sliver);
}

} // namespace billet::geometry::mesh_3
