#include "mechanics/mesh/mesh.h"

#include "mechanics/mesh/mesh_edges.h"

#include <algorithm>
#include <cstddef>

namespace billet::mechanics {

namespace {

using FaceTable = std::vector<std::vector<int>>;

/// Corners of each face, outward.
FaceTable corner_table(ElementKind kind) {
  switch (kind) {
  case ElementKind::tri6:
    return {{0, 1}, {1, 2}, {2, 0}};
  case ElementKind::quad4:
  case ElementKind::quad8:
    return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  case ElementKind::tet4:
  case ElementKind::tet10:
    return {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  case ElementKind::hex8:
  case ElementKind::hex20:
    return {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  }
  return {};
}

/// The mid-side node between two corners.
int node_between(ElementKind kind, int a, int b) {
  const auto edges = element_edges(kind);
  const auto joins = [&](const std::array<int, 2>& edge) {
    return (edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a);
  };
  const auto edge = std::find_if(edges.begin(), edges.end(), joins);
  return corners_per_element(kind) + static_cast<int>(edge - edges.begin());
}

FaceTable face_table(ElementKind kind) {
  FaceTable table = corner_table(kind);
  if (!is_quadratic(kind))
    return table;
  for (std::vector<int>& face : table) {
    const std::size_t n_corners = face.size();
    // A line has one middle, a closed face one for each side.
    const std::size_t n_sides = n_corners == 2 ? 1 : n_corners;
    for (std::size_t i = 0; i < n_sides; ++i)
      face.push_back(node_between(kind, face[i], face[(i + 1) % n_corners]));
  }
  return table;
}

/// A face seen as the set of its corners, so that both neighbours give the same key.
struct FaceKey {
  std::array<Index, 4> corners{-1, -1, -1, -1}; ///< sorted
  std::size_t face;                             ///< position in the list by cell and local face
};

std::vector<FaceKey> face_keys(const Mesh& mesh) {
  const FaceTable corners = corner_table(mesh.kind);
  std::vector<FaceKey> keys;
  keys.reserve(static_cast<std::size_t>(mesh.n_elements()) * corners.size());
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const auto cell = mesh.cell(element);
    for (const std::vector<int>& face : corners) {
      FaceKey key{.face = keys.size()};
      std::transform(face.begin(), face.end(), key.corners.begin(),
                     [&](int node) { return cell[static_cast<std::size_t>(node)]; });
      std::sort(key.corners.begin(), key.corners.end());
      keys.push_back(key);
    }
  }
  return keys;
}

/// Positions of the faces no other cell shares, ascending.
std::vector<std::size_t> unshared(std::vector<FaceKey> keys) {
  std::sort(keys.begin(), keys.end(),
            [](const FaceKey& a, const FaceKey& b) { return a.corners < b.corners; });
  std::vector<std::size_t> single;
  for (auto first = keys.begin(); first != keys.end();) {
    const auto last = std::find_if(
        first, keys.end(), [&](const FaceKey& key) { return key.corners != first->corners; });
    if (last - first == 1)
      single.push_back(first->face);
    first = last;
  }
  std::sort(single.begin(), single.end());
  return single;
}

} // namespace

int nodes_per_element(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
  case ElementKind::tet4:
    return 4;
  case ElementKind::tri6:
    return 6;
  case ElementKind::quad8:
  case ElementKind::hex8:
    return 8;
  case ElementKind::tet10:
    return 10;
  case ElementKind::hex20:
    return 20;
  }
  return 0;
}

int dimension(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
  case ElementKind::quad8:
  case ElementKind::tri6:
    return 2;
  case ElementKind::hex8:
  case ElementKind::hex20:
  case ElementKind::tet4:
  case ElementKind::tet10:
    return 3;
  }
  return 0;
}

std::string_view name(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
    return "quad4";
  case ElementKind::quad8:
    return "quad8";
  case ElementKind::tri6:
    return "tri6";
  case ElementKind::hex8:
    return "hex8";
  case ElementKind::hex20:
    return "hex20";
  case ElementKind::tet4:
    return "tet4";
  case ElementKind::tet10:
    return "tet10";
  }
  return "";
}

std::span<const std::vector<int>> face_nodes(ElementKind kind) {
  static const std::array<FaceTable, 7> tables{
      face_table(ElementKind::quad4), face_table(ElementKind::quad8), face_table(ElementKind::tri6),
      face_table(ElementKind::hex8),  face_table(ElementKind::hex20), face_table(ElementKind::tet4),
      face_table(ElementKind::tet10)};
  return tables[static_cast<std::size_t>(kind)];
}

std::vector<Face> boundary_faces(const Mesh& mesh) {
  const auto table = face_nodes(mesh.kind);
  std::vector<Face> faces;
  for (const std::size_t position : unshared(face_keys(mesh))) {
    Face face{.element = static_cast<Index>(position / table.size()), .nodes = {}};
    const auto cell = mesh.cell(face.element);
    for (const int node : table[position % table.size()])
      face.nodes.push_back(cell[static_cast<std::size_t>(node)]);
    faces.push_back(std::move(face));
  }
  return faces;
}

std::vector<double> node_positions(const Mesh& mesh) {
  std::vector<double> x;
  x.reserve(mesh.points.size() * static_cast<std::size_t>(mesh.dimension()));
  for (const Vec3& p : mesh.points)
    x.insert(x.end(), p.data(), p.data() + mesh.dimension());
  return x;
}

} // namespace billet::mechanics
