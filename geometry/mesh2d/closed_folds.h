// Places where a boundary in the plane meets itself: folds whose mouth has closed.
//
// Metal that rolls over itself leaves a crease; once its walls touch, a mesh without contact with
// itself lets them cross. Cutting the crease off welds its walls: the boundary then passes from one
// lip of the mouth to the other. Theory: docs/theory/geometry.md (G.54).
//
// Units   mm.

#pragma once

#include "geometry/mesh2d/domain_remesher.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace billet::geometry {

/// What lies between two places where a loop meets itself.
struct ClosedFold {
  BoundaryPlace from; ///< the first lip; `loop` is 0
  BoundaryPlace to;   ///< the second one, further on around the loop
  Vec2 at;            ///< where they meet
  double way;         ///< along the boundary from lip to lip [mm]

  [[nodiscard]] double depth() const { return 0.5 * way; } ///< of the crease [mm]
};

/// The longest closed fold of a loop that is small compared with it: a quarter of the way round and
/// 2 % of the area at most.
///
/// @param stays  edges that no fold may hold, shape (n_sides): supports, say
/// @param near   lips meet that are no farther than this from each other, if what lies between is
///               outside and deeper than twice that; 0: they have to cross [mm]
/// @param deepest  that it may be [mm]
/// @param welds  places of roots that have been welded: a fold within twice `deepest` of one is the
///               rest of the same crease, and is left
[[nodiscard]] std::optional<ClosedFold> closed_fold(const SideLoop& loop,
                                                    std::span<const char> stays,
                                                    double near,
                                                    double deepest = HUGE_VAL,
                                                    std::span<const Vec2> welds = {});

/// A loop without a fold, and where it comes from.
struct WeldedLoop {
  SideLoop loop;
  std::vector<std::int32_t> sides;   ///< of the old loop
  std::vector<std::int32_t> corners; ///< of the old loop; -1: the place of the weld
};

/// Cuts a fold off. The edges that meet at the weld are straight.
///
/// @param rest  shortest edge there, but for edges between kept corners [mm]
[[nodiscard]] WeldedLoop without_fold(const SideLoop& loop, const ClosedFold& fold, double rest);

} // namespace billet::geometry
