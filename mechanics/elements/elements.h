// The elements the solver knows: shape, integration rule, treatment of volume change.
//
// quad8, hex20   displacement elements with the reduced rule (2 per direction), as in the paper.
// tri6, tet10    the same with 3 and 4 points (docs/decisions/0008-simplex-elements.md).
// tet4           one point, uniform strain; locks where volume is kept (same decision).
// quad4, hex8    variational mean dilatation: one pressure and one dilatation per element.
// A new element is one struct here and one line in `visit_element`.

#pragma once

#include "mechanics/elements/shapes.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/numerics/quadrature.h"

#include <stdexcept>

namespace billet::mechanics {

struct ElementQuad4 {
  using Shape = Quad4;
  using Rule = GaussRule<2, 2>;
  static constexpr bool mean_dilatation = true;
};
struct ElementQuad8 {
  using Shape = Quad8;
  using Rule = GaussRule<2, 2>;
  static constexpr bool mean_dilatation = false;
};
struct ElementHex8 {
  using Shape = Hex8;
  using Rule = GaussRule<3, 2>;
  static constexpr bool mean_dilatation = true;
};
struct ElementHex20 {
  using Shape = Hex20;
  using Rule = GaussRule<3, 2>;
  static constexpr bool mean_dilatation = false;
};

struct ElementTri6 {
  using Shape = Tri6;
  using Rule = SimplexRule<2, 3>;
  static constexpr bool mean_dilatation = false;
};
struct ElementTet4 {
  using Shape = Tet4;
  using Rule = SimplexRule<3, 1>;
  static constexpr bool mean_dilatation = false;
};
struct ElementTet10 {
  using Shape = Tet10;
  using Rule = SimplexRule<3, 4>;
  static constexpr bool mean_dilatation = false;
};

/// Calls `visitor` with the element type of `kind`.
template <class Visitor> decltype(auto) visit_element(ElementKind kind, Visitor&& visitor) {
  switch (kind) {
  case ElementKind::quad4:
    return visitor(ElementQuad4{});
  case ElementKind::quad8:
    return visitor(ElementQuad8{});
  case ElementKind::hex8:
    return visitor(ElementHex8{});
  case ElementKind::hex20:
    return visitor(ElementHex20{});
  case ElementKind::tri6:
    return visitor(ElementTri6{});
  case ElementKind::tet4:
    return visitor(ElementTet4{});
  case ElementKind::tet10:
    return visitor(ElementTet10{});
  }
  throw std::logic_error("element kind without a kernel");
}

/// Number of integration points of an element.
[[nodiscard]] inline int points_per_element(ElementKind kind) {
  return visit_element(kind, [](auto element) { return decltype(element)::Rule::points; });
}

} // namespace billet::mechanics
