// Which triangles share which edge; internal to geometry/.

#pragma once

#include "geometry/triangles/triangle_mesh.h"

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

/// A side of a triangle; sides of the same edge sort next to each other.
struct EdgeUse {
  std::int32_t low;      ///< smaller point number of the edge
  std::int32_t high;     ///< larger
  std::int32_t triangle; ///< whose side it is
  std::int32_t side;     ///< 0, 1, 2: from corner `side` to the next
  bool forward;          ///< the triangle runs from `low` to `high`

  auto operator<=>(const EdgeUse&) const = default;
};

/// Corner number, 3 triangle + corner, of the side's triangle at the edge's smaller point.
[[nodiscard]] inline std::int32_t corner_at_low(const EdgeUse& use) {
  return 3 * use.triangle + (use.forward ? use.side : (use.side + 1) % 3);
}
/// The same at its larger point.
[[nodiscard]] inline std::int32_t corner_at_high(const EdgeUse& use) {
  return 3 * use.triangle + (use.forward ? (use.side + 1) % 3 : use.side);
}

/// All sides, sorted. shape (3 n_triangles)
[[nodiscard]] std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh);

/// Calls `visit(std::span<const EdgeUse>)` for every edge, with all its sides.
template <class Visit> void for_each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high)
      ++j;
    visit(std::span<const EdgeUse>(uses).subspan(i, j - i));
    i = j;
  }
}

} // namespace billet::geometry
