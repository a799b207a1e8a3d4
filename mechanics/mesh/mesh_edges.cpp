#include "mechanics/mesh/mesh_edges.h"

namespace billet::mechanics {

namespace {

using Edge = std::array<int, 2>;

constexpr std::array<Edge, 3> triangle{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Edge, 4> quad{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Edge, 6> tetrahedron{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 12> hexahedron{{{0, 1},
                                           {1, 2},
                                           {2, 3},
                                           {3, 0},
                                           {4, 5},
                                           {5, 6},
                                           {6, 7},
                                           {7, 4},
                                           {0, 4},
                                           {1, 5},
                                           {2, 6},
                                           {3, 7}}};

} // namespace

int corners_per_element(ElementKind kind) {
  switch (kind) {
  case ElementKind::tri6:
    return 3;
  case ElementKind::quad4:
  case ElementKind::quad8:
  case ElementKind::tet4:
  case ElementKind::tet10:
    return 4;
  case ElementKind::hex8:
  case ElementKind::hex20:
    return 8;
  }
  return 0;
}

std::size_t corners_per_face(ElementKind kind) {
  if (dimension(kind) == 2)
    return 2;
  return is_simplex(kind) ? 3 : 4;
}

bool is_quadratic(ElementKind kind) { return nodes_per_element(kind) != corners_per_element(kind); }

bool is_simplex(ElementKind kind) {
  return kind == ElementKind::tri6 || kind == ElementKind::tet4 || kind == ElementKind::tet10;
}

std::span<const Edge> element_edges(ElementKind kind) {
  switch (kind) {
  case ElementKind::tri6:
    return triangle;
  case ElementKind::quad4:
  case ElementKind::quad8:
    return quad;
  case ElementKind::tet4:
  case ElementKind::tet10:
    return tetrahedron;
  case ElementKind::hex8:
  case ElementKind::hex20:
    return hexahedron;
  }
  return {};
}

} // namespace billet::mechanics
