// What the page shows of a mesh: its faces as rings of nodes, and for cuts its cells by their
// corners.
//
// In the plane every element is a face; in space those of the surface are. Nodes in the middle of
// edges inside the part are left out: a cut interpolates between corners.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace billet::report {

struct ShownMesh {
  std::vector<mechanics::Index> nodes; ///< of the mesh, those in use; increasing
  std::size_t ring = 0;                ///< nodes around a face: corners, and mid-sides between them
  std::vector<mechanics::Index> faces; ///< shape (n_faces, ring), numbers among `nodes`
  std::vector<mechanics::Index> face_elements; ///< shape (n_faces)
  std::size_t corners = 0;                     ///< of a cell; 0: cells are left out
  std::vector<mechanics::Index> cells;         ///< shape (n_cells, corners), among `nodes`

  /// Number among `nodes`; -1: it is left out.
  [[nodiscard]] mechanics::Index number(mechanics::Index node) const;
};

/// @param volume  with the cells; of no effect in the plane
[[nodiscard]] ShownMesh shown(const mechanics::Mesh& mesh, bool volume);

/// Values at the nodes that are shown.
/// @param values  shape (n_points, components)
[[nodiscard]] std::vector<double>
of_shown_nodes(const ShownMesh& mesh, std::span<const double> values, std::size_t components);

/// A face's nodes, corners first and mid-sides after them, as they follow each other around it.
[[nodiscard]] std::vector<mechanics::Index> ring_of(std::span<const mechanics::Index> face);

} // namespace billet::report
