#include "geometry/triangles/edge_table.h"

#include <algorithm>
#include <cstddef>

namespace billet::geometry {

// Sorted by the smaller point first, by counting, since a point has few sides.
std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh) {
  std::vector<std::size_t> start(mesh.points.size() + 1, 0);
  const auto low_of = [&](std::size_t t, std::size_t side) {
    return std::min(mesh.triangles[t][side], mesh.triangles[t][(side + 1) % 3]);
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side)
      ++start[static_cast<std::size_t>(low_of(t, side)) + 1];
  for (std::size_t i = 1; i < start.size(); ++i)
    start[i] += start[i - 1];
  std::vector<EdgeUse> uses(3 * mesh.triangles.size());
  std::vector<std::size_t> next = start;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side) {
      const std::int32_t from = mesh.triangles[t][side], to = mesh.triangles[t][(side + 1) % 3];
      const std::int32_t low = std::min(from, to);
      uses[next[static_cast<std::size_t>(low)]++] = {low, std::max(from, to),
                                                     static_cast<std::int32_t>(t),
                                                     static_cast<std::int32_t>(side), from < to};
    }
  const auto at = [&](std::size_t i) { return uses.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t i = 0; i + 1 < start.size(); ++i)
    std::sort(at(start[i]), at(start[i + 1]));
  return uses;
}

} // namespace billet::geometry
