#include "mechanics/mesh/domain_meshes.h"

#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace billet::mechanics {

namespace {

using MeshEdge = std::pair<Index, Index>;

MeshEdge edge_between(Index a, Index b) { return std::minmax(a, b); }

/// The middle node of every edge.
std::map<MeshEdge, Index> middles(const Mesh& mesh) {
  std::map<MeshEdge, Index> result;
  const auto edges = element_edges(mesh.kind);
  const auto n_corners = static_cast<std::size_t>(corners_per_element(mesh.kind));
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    const auto cell = mesh.cell(e);
    for (std::size_t i = 0; i < edges.size(); ++i)
      result[edge_between(cell[static_cast<std::size_t>(edges[i][0])],
                          cell[static_cast<std::size_t>(edges[i][1])])] = cell[n_corners + i];
  }
  return result;
}

template <std::size_t n>
std::vector<Index> in_one_list(const std::vector<std::array<std::int32_t, n>>& cells) {
  std::vector<Index> corners;
  corners.reserve(n * cells.size());
  for (const auto& cell : cells)
    corners.insert(corners.end(), cell.begin(), cell.end());
  return corners;
}

} // namespace

Mesh triangle_mesh(const geometry::PlaneMesh& domain) {
  std::vector<Vec3> points;
  points.reserve(domain.points.size());
  for (const Vec2& p : domain.points)
    points.emplace_back(p.x(), p.y(), 0.0);
  Mesh mesh = quadratic_mesh(ElementKind::tri6, std::move(points), in_one_list(domain.triangles));
  const std::map<MeshEdge, Index> middle_of = middles(mesh);
  for (const geometry::BoundarySide& boundary : domain.boundary) {
    const auto [a, b] = boundary.corners;
    const Index middle = middle_of.at(edge_between(a, b));
    mesh.points[static_cast<std::size_t>(middle)] =
        Vec3(boundary.middle.x(), boundary.middle.y(), 0.0);
    std::vector<Index>& set = mesh.node_sets[fmt::format("segment-{}", boundary.segment + 1)];
    set.insert(set.end(), {a, b, middle});
  }
  for (auto& [name, nodes] : mesh.node_sets) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return mesh;
}

Mesh tetrahedron_mesh(const geometry::SolidMesh& domain) {
  return quadratic_mesh(ElementKind::tet10, domain.points, in_one_list(domain.tetrahedra));
}

Mesh tetrahedron_mesh(const geometry::RemeshedSolid& solid) {
  Mesh mesh = tetrahedron_mesh(solid.mesh);
  const std::map<MeshEdge, Index> middle_of = middles(mesh);
  for (const geometry::RemeshedSolid::Edge& edge : solid.edges)
    mesh.points[static_cast<std::size_t>(
        middle_of.at(edge_between(edge.corners[0], edge.corners[1])))] = edge.middle;
  return mesh;
}

} // namespace billet::mechanics
