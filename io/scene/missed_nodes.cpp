#include "io/scene/missed_nodes.h"

#include "geometry/base/index.h"
#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::io {

using mechanics::Face;
using mechanics::Index;

namespace {

/// Unit normal of a face, by its first corners.
Vec3 normal_of(const mechanics::Mesh& mesh, const Face& face) {
  const auto x = [&](std::size_t i) -> const Vec3& { return mesh.points[idx(face.nodes[i])]; };
  const Vec3 side = x(1) - x(0);
  const Vec3 normal =
      mesh.dimension() == 2 ? Vec3(side.y(), -side.x(), 0.0) : Vec3(side.cross(x(2) - x(0)));
  return normal.normalized();
}

} // namespace

std::optional<std::string> nodes_near_plane(const mechanics::Mesh& mesh,
                                            const std::vector<Face>& surface,
                                            const std::vector<char>& on_plane,
                                            int axis,
                                            double value,
                                            double size) {
  constexpr double furthest = 2e-4; // of the size of the mesh
  constexpr double parallel = 0.98; // cosine
  const auto off = [&](Index i) { return std::abs(mesh.points[idx(i)][axis] - value); };
  // Nodes of faces that lie so near to it, but for those from which the surface goes on and leaves
  // the plane, round or flat.
  std::vector<char> near(mesh.points.size(), 0), leaves(mesh.points.size(), 0);
  std::vector<const Face*> flat;
  for (const Face& face : surface) {
    if (std::abs(normal_of(mesh, face)[axis]) < parallel)
      continue;
    const bool lies_near = std::all_of(face.nodes.begin(), face.nodes.end(),
                                       [&](Index i) { return off(i) <= furthest * size; });
    if (lies_near)
      flat.push_back(&face);
    for (const Index i : face.nodes)
      if (on_plane[idx(i)] == 0)
        (lies_near ? near : leaves)[idx(i)] = 1;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face* face : flat) {
      const auto leads_away = [&](Index i) { return leaves[idx(i)] != 0; };
      if (std::none_of(face->nodes.begin(), face->nodes.end(), leads_away))
        continue;
      for (const Index i : face->nodes)
        if (on_plane[idx(i)] == 0 && leaves[idx(i)] == 0)
          leaves[idx(i)] = changed = true;
    }
  }
  for (std::size_t i = 0; i < near.size(); ++i)
    if (leaves[i] != 0)
      near[i] = 0;
  const auto n = std::count(near.begin(), near.end(), 1);
  if (n == 0 || std::find(on_plane.begin(), on_plane.end(), 1) == on_plane.end())
    return std::nullopt;
  double most = 0.0;
  for (Index i = 0; i < mesh.n_points(); ++i)
    if (near[idx(i)] != 0)
      most = std::max(most, off(i));
  return fmt::format(
      "{} node(s) next to those on the plane {} = {} lie up to {:.2g} off it, and "
      "are not meant: on it is what lies within 1e-6 of the size of the mesh, {:.2g}",
      n, "xyz"[axis], value, most, 1e-6 * size);
}

std::optional<std::string> missed_middle_nodes(const mechanics::Mesh& mesh,
                                               const std::vector<Face>& surface,
                                               const std::vector<char>& meant) {
  if (!mechanics::is_quadratic(mesh.kind))
    return std::nullopt;
  const auto is_meant = [&](Index i) { return meant[idx(i)] != 0; };
  long sides = 0;
  for (const Face& face : surface) {
    const auto corners = static_cast<std::ptrdiff_t>((face.nodes.size() + 1) / 2);
    const auto middle = face.nodes.begin() + corners;
    if (std::all_of(face.nodes.begin(), middle, is_meant) &&
        std::none_of(middle, face.nodes.end(), is_meant)) // some may be those of other faces
      ++sides;
  }
  if (sides == 0)
    return std::nullopt;
  return fmt::format("{} face(s) of quadratic elements have all their corners there, but none of "
                     "their middle nodes: those are not meant, and no load acts on these faces",
                     sides);
}

} // namespace billet::io
