// The workpiece as a mesh: points, cells of one kind, named sets.
//
// Node numbering within a cell is VTK's (quad: corners counter-clockwise, then mid-sides in the
// order of the sides 0-1, 1-2, ...; hexahedron: bottom 0-3, top 4-7, then mid-edges of the bottom
// 8-11, of the top 12-15, vertical 16-19; triangle and tetrahedron: corners, then mid-sides of 0-1,
// 1-2, 2-0 and, in space, 0-3, 1-3, 2-3).

#pragma once

#include "geometry/base/index.h"
#include "geometry/base/vector.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace billet::mechanics {

using Index = std::int32_t;

/// Kinds of cell the solver knows by name.
/// `tet4` is for parts that stay elastic or nearly so, and for what is handed 3-node faces: it
/// locks where metal flows (docs/decisions/0008-simplex-elements.md), and case files do not offer
/// it.
enum class ElementKind { quad4, quad8, tri6, hex8, hex20, tet4, tet10 };

/// Number of nodes of a cell.
[[nodiscard]] int nodes_per_element(ElementKind kind);
/// 2 or 3.
[[nodiscard]] int dimension(ElementKind kind);
/// "quad4", ...
[[nodiscard]] std::string_view name(ElementKind kind);

/// A face of a cell: its nodes in the order of a line2/line3/quad4/quad8/tri3/tri6 with outward
/// orientation (in the plane the body lies on the left of the direction of travel; in space the
/// nodes turn counter-clockwise seen from outside). Corners first, then mid-sides.
struct Face {
  Index element;            ///< the cell it belongs to
  std::vector<Index> nodes; ///< global node numbers

  template <class Archive> void fields(Archive& archive) { archive(element, nodes); }
};

/// Points and cells of one kind.
struct Mesh {
  ElementKind kind = ElementKind::quad4;
  std::vector<Vec3> points;                            ///< [mm]; z = 0 in the plane
  std::vector<Index> cells;                            ///< shape (n_elements, nodes_per_element)
  std::map<std::string, std::vector<Index>> node_sets; ///< sorted node numbers

  [[nodiscard]] int dimension() const { return mechanics::dimension(kind); }
  [[nodiscard]] Index n_points() const { return static_cast<Index>(points.size()); }
  [[nodiscard]] Index n_elements() const {
    return static_cast<Index>(cells.size()) / nodes_per_element(kind);
  }
  [[nodiscard]] std::span<const Index> cell(Index element) const {
    const auto n = static_cast<std::size_t>(nodes_per_element(kind));
    return std::span(cells).subspan(static_cast<std::size_t>(element) * n, n);
  }

  template <class Archive> void fields(Archive& archive) {
    archive(kind, points, cells, node_sets);
  }
};

/// Positions of a mesh's nodes in a row, shape (n_points, dim) [mm].
[[nodiscard]] std::vector<double> node_positions(const Mesh& mesh);

/// Where a node is, of the positions of all nodes in a row. [mm]; z = 0 in the plane
[[nodiscard]] inline Vec3 node_position(std::span<const double> x, int dim, Index node) {
  Vec3 position = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
    position[i] = x[idx(dim * node + i)];
  return position;
}

/// Local node numbers of each face of a cell, outward (see Face).
[[nodiscard]] std::span<const std::vector<int>> face_nodes(ElementKind kind);

/// Faces that belong to one cell only, ordered by cell and local face number.
[[nodiscard]] std::vector<Face> boundary_faces(const Mesh& mesh);

} // namespace billet::mechanics
