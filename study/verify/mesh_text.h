// Meshes of problems, as the text of an Abaqus input file.

#pragma once

#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace billet::study {

/// Corners and cells of quadrilaterals or bricks: what meshes of other elements are made of.
struct CornerMesh {
  std::vector<Vec3> points;            ///< [mm]
  std::vector<std::vector<int>> cells; ///< 4 or 8 corners each, numbered as mechanics::Mesh
};

/// A rectangle of nx by ny cells, each corner moved to place(i / nx, j / ny) [mm].
[[nodiscard]] CornerMesh
mapped_grid(int nx, int ny, const std::function<Vec3(double, double)>& place);

/// The mesh with the elements of a kind: quadrilaterals are cut into triangles, bricks into
/// tetrahedra, and mid-side nodes stand in the middle of their corners.
[[nodiscard]] mechanics::Mesh with_elements(mechanics::ElementKind kind, const CornerMesh& corners);

/// Makes a set of the nodes at which something holds of their position.
void name_nodes(mechanics::Mesh& mesh,
                const std::string& set,
                const std::function<bool(const Vec3&)>& belongs);

/// Makes a set "node-N" of each node of another set, so that a case may move them one by one.
void name_each_node(mechanics::Mesh& mesh, const std::string& set);

/// In which order a file lists its nodes.
enum class NodeOrder { forward, backward };

/// The text of an `.inp` file with the mesh and its node sets.
[[nodiscard]] std::string inp_text(const mechanics::Mesh& mesh,
                                   NodeOrder order = NodeOrder::forward);

} // namespace billet::study
