#include "app/report/shown_mesh.h"

#include <algorithm>

namespace billet::report {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

std::size_t corners_of(ElementKind kind) {
  switch (kind) {
  case ElementKind::hex8:
  case ElementKind::hex20:
    return 8;
  case ElementKind::tri6:
    return 3;
  default:
    return 4;
  }
}

/// Faces to be drawn, by nodes of the mesh.
void add_faces(const mechanics::Mesh& mesh, ShownMesh& shown) {
  if (mesh.dimension() == 2) {
    for (Index e = 0; e < mesh.n_elements(); ++e) {
      const std::vector<Index> ring = ring_of(mesh.cell(e));
      shown.faces.insert(shown.faces.end(), ring.begin(), ring.end());
      shown.face_elements.push_back(e);
      shown.ring = ring.size();
    }
    return;
  }
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh)) {
    const std::vector<Index> ring = ring_of(face.nodes);
    shown.faces.insert(shown.faces.end(), ring.begin(), ring.end());
    shown.face_elements.push_back(face.element);
    shown.ring = ring.size();
  }
}

void add_cells(const mechanics::Mesh& mesh, ShownMesh& shown) {
  shown.corners = corners_of(mesh.kind);
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    const std::span<const Index> corners = mesh.cell(e).first(shown.corners);
    shown.cells.insert(shown.cells.end(), corners.begin(), corners.end());
  }
}

} // namespace

Index ShownMesh::number(Index node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found != nodes.end() && *found == node ? static_cast<Index>(found - nodes.begin()) : -1;
}

std::vector<Index> ring_of(std::span<const Index> face) {
  if (face.size() <= 4)
    return {face.begin(), face.end()};
  std::vector<Index> ring;
  const std::size_t n = face.size() / 2;
  for (std::size_t i = 0; i < n; ++i)
    ring.insert(ring.end(), {face[i], face[n + i]});
  return ring;
}

ShownMesh shown(const mechanics::Mesh& mesh, bool volume) {
  ShownMesh shown;
  add_faces(mesh, shown);
  if (volume && mesh.dimension() == 3)
    add_cells(mesh, shown);
  for (const auto* numbers : {&shown.faces, &shown.cells})
    shown.nodes.insert(shown.nodes.end(), numbers->begin(), numbers->end());
  std::sort(shown.nodes.begin(), shown.nodes.end());
  shown.nodes.erase(std::unique(shown.nodes.begin(), shown.nodes.end()), shown.nodes.end());
  for (auto* numbers : {&shown.faces, &shown.cells})
    for (Index& node : *numbers)
      node = shown.number(node);
  return shown;
}

std::vector<double>
of_shown_nodes(const ShownMesh& mesh, std::span<const double> values, std::size_t components) {
  std::vector<double> chosen;
  chosen.reserve(mesh.nodes.size() * components);
  for (const Index node : mesh.nodes)
    for (std::size_t c = 0; c < components; ++c)
      chosen.push_back(values[idx(node) * components + c]);
  return chosen;
}

} // namespace billet::report
