#include "study/verify/mesh_text.h"

#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace billet::study {

namespace {

using mechanics::ElementKind;
using mechanics::Index;
using CornerCells = std::vector<std::vector<int>>;

/// Quadrilaterals cut along the diagonal from their first corner.
CornerCells triangles_of(const CornerCells& quadrilaterals) {
  CornerCells triangles;
  for (const std::vector<int>& q : quadrilaterals) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

/// Bricks cut into twelve: two over each face, with a corner in the middle of the brick. A face is
/// cut from its lowest number, so that both bricks that share it cut it in the same way.
CornerCells tetrahedra_of(const CornerCells& bricks, std::vector<Vec3>& points) {
  CornerCells tetrahedra;
  for (const std::vector<int>& brick : bricks) {
    Vec3 middle = Vec3::Zero();
    for (const int corner : brick)
      middle += 0.125 * points[static_cast<std::size_t>(corner)];
    const auto apex = static_cast<int>(points.size());
    points.push_back(middle);
    for (const std::vector<int>& side : mechanics::face_nodes(ElementKind::hex8)) {
      std::array<int, 4> q{};
      for (std::size_t i = 0; i < 4; ++i)
        q[i] = brick[static_cast<std::size_t>(side[i])];
      std::rotate(q.begin(), std::min_element(q.begin(), q.end()), q.end());
      // Seen from outside the side turns counter-clockwise: from within it is the base.
      tetrahedra.push_back({q[0], q[2], q[1], apex});
      tetrahedra.push_back({q[0], q[3], q[2], apex});
    }
  }
  return tetrahedra;
}

/// Adds a node in the middle of each edge.
void add_middle_nodes(mechanics::Mesh& mesh, const CornerCells& cells) {
  std::map<std::pair<int, int>, Index> middles;
  for (const std::vector<int>& cell : cells) {
    mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
    if (!mechanics::is_quadratic(mesh.kind))
      continue;
    for (const auto& edge : mechanics::element_edges(mesh.kind)) {
      const int a = cell[static_cast<std::size_t>(edge[0])];
      const int b = cell[static_cast<std::size_t>(edge[1])];
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), mesh.n_points());
      if (is_new) {
        const Vec3 middle = 0.5 * (mesh.points[static_cast<std::size_t>(a)] +
                                   mesh.points[static_cast<std::size_t>(b)]);
        mesh.points.push_back(middle);
      }
      mesh.cells.push_back(found->second);
    }
  }
}

std::string_view abaqus_name(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
    return "CPE4";
  case ElementKind::quad8:
    return "CPE8";
  case ElementKind::tri6:
    return "CPE6";
  case ElementKind::hex8:
    return "C3D8";
  case ElementKind::hex20:
    return "C3D20";
  case ElementKind::tet4:
    return "C3D4";
  case ElementKind::tet10:
    return "C3D10";
  }
  return "";
}

} // namespace

CornerMesh mapped_grid(int nx, int ny, const std::function<Vec3(double, double)>& place) {
  CornerMesh grid;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      grid.points.push_back(place(static_cast<double>(i) / nx, static_cast<double>(j) / ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int first = j * (nx + 1) + i;
      grid.cells.push_back({first, first + 1, first + nx + 2, first + nx + 1});
    }
  return grid;
}

mechanics::Mesh with_elements(ElementKind kind, const CornerMesh& corners) {
  mechanics::Mesh mesh;
  mesh.kind = kind;
  mesh.points = corners.points;
  CornerCells cells = corners.cells;
  if (kind == ElementKind::tri6)
    cells = triangles_of(cells);
  if (kind == ElementKind::tet10)
    cells = tetrahedra_of(cells, mesh.points);
  add_middle_nodes(mesh, cells);
  return mesh;
}

void name_nodes(mechanics::Mesh& mesh,
                const std::string& set,
                const std::function<bool(const Vec3&)>& belongs) {
  std::vector<Index>& nodes = mesh.node_sets[set];
  for (Index node = 0; node < mesh.n_points(); ++node)
    if (belongs(mesh.points[static_cast<std::size_t>(node)]))
      nodes.push_back(node);
}

void name_each_node(mechanics::Mesh& mesh, const std::string& set) {
  const std::vector<Index> nodes = mesh.node_sets.at(set);
  for (const Index node : nodes)
    mesh.node_sets[fmt::format("node-{}", node)] = {node};
}

std::string inp_text(const mechanics::Mesh& mesh, NodeOrder order) {
  std::string text = "*NODE\n";
  for (Index k = 0; k < mesh.n_points(); ++k) {
    const Index node = order == NodeOrder::forward ? k : mesh.n_points() - 1 - k;
    const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
    text += fmt::format("{}, {}, {}, {}\n", node + 1, p[0], p[1], p[2]);
  }
  text += fmt::format("*ELEMENT, TYPE={}\n", abaqus_name(mesh.kind));
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    text += fmt::format("{}", e + 1);
    int on_line = 1;
    for (const Index node : mesh.cell(e))
      text += fmt::format("{}{}", on_line++ % 12 == 0 ? ",\n" : ", ", node + 1);
    text += '\n';
  }
  for (const auto& [set, nodes] : mesh.node_sets) {
    text += fmt::format("*NSET, NSET={}\n", set);
    for (const Index node : nodes)
      text += fmt::format("{},\n", node + 1);
  }
  return text;
}

} // namespace billet::study
