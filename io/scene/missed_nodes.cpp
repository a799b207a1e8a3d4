#include "io/scene/missed_nodes.h"

#include "geometry/base/index.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace billet::io {

using mechanics::Face;
using mechanics::Index;

std::optional<std::string> nodes_near_plane(const mechanics::Mesh& mesh,
                                            const std::vector<char>& on_plane,
                                            int axis,
                                            double value,
                                            double size) {
  constexpr double furthest = 2e-4; // of the size of the mesh
  constexpr double most_slope =
      0.02; // from the nearest node on the plane: finer layers are no slip
  const auto off = [&](Index i) { return std::abs(mesh.points[idx(i)][axis] - value); };
  std::vector<char> near(mesh.points.size(), 0);
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    const std::span<const Index> cell = mesh.cell(e);
    for (const Index i : cell) {
      if (on_plane[idx(i)] != 0 || off(i) > furthest * size)
        continue;
      double nearest = HUGE_VAL;
      for (const Index other : cell)
        if (on_plane[idx(other)] != 0)
          nearest = std::min(nearest, (mesh.points[idx(i)] - mesh.points[idx(other)]).norm());
      if (off(i) < most_slope * nearest && nearest < HUGE_VAL)
        near[idx(i)] = 1;
    }
  }
  const auto n = std::count(near.begin(), near.end(), 1);
  if (n == 0)
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
        !std::all_of(middle, face.nodes.end(), is_meant))
      ++sides;
  }
  if (sides == 0)
    return std::nullopt;
  return fmt::format("{} face(s) of quadratic elements have all their corners there, but not all "
                     "their middle nodes: those are not meant, and no load acts on these faces",
                     sides);
}

} // namespace billet::io
