#include "geometry/collision/facet_tree.h"

#include "geometry/base/late_library.h"

namespace billet::geometry {

std::unique_ptr<const FacetTree> make_facet_tree(std::span<const double> points,
                                                 std::span<const FacetTree::Triangle> triangles) {
  using Make = const FacetTree*(std::span<const double>, std::span<const FacetTree::Triangle>);
  static Make* const make = late_function<Make>("billet_fcl.so", "billet_make_facet_tree");
  return std::unique_ptr<const FacetTree>(make(points, triangles));
}

} // namespace billet::geometry
