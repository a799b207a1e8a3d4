#include "geometry/edge_table.h"

#include <algorithm>

namespace billet::geometry {

std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side) {
      const std::int32_t from = mesh.triangles[t][side], to = mesh.triangles[t][(side + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t),
                      static_cast<std::int32_t>(side), from < to});
    }
  std::sort(uses.begin(), uses.end());
  return uses;
}

} // namespace billet::geometry
