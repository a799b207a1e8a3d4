// Loops of a boundary laid where they should be before they are resampled. Internal to geometry/.
//
// A side that a tool has sunk into between its nodes has to go a long way for its length: if only
// the nodes of new sides went there, corners and middles would run into each other. So such sides
// are divided first and all that they are divided into is moved. Theory: docs/theory/geometry.md
// (G.49).
//
// Units   mm.

#pragma once

#include "geometry/mesh2d/domain_remesher.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

class SnappedLoops {
public:
  /// @param snap  where nodes of the boundary should be; empty: the loops stay as they are
  /// @param least   length that sides need not be divided below [mm], > 0
  /// @pre the loops have been found sound
  SnappedLoops(std::span<const SideLoop> loops, const Snap& snap, double least);

  [[nodiscard]] const std::vector<SideLoop>& loops() const { return loops_; }
  /// Where a place on the snapped loops is on those that they were made of.
  [[nodiscard]] BoundaryPlace original(const BoundaryPlace& place) const;

private:
  /// Part of a side of the loops before.
  struct Piece {
    std::int32_t side;
    double from, to; ///< [-]
  };

  /// Joins pieces that are no longer than `shortest` with a neighbour of the same old edge.
  static void join_short(SideLoop& loop, std::vector<Piece>& pieces, double shortest);
  static void erase(SideLoop& loop, std::vector<Piece>& pieces, std::size_t i);
  void add(const SideLoop& loop, std::int32_t number, const Snap& snap, double least);

  std::vector<SideLoop> loops_;
  std::vector<std::vector<Piece>> pieces_; ///< of each side of each loop
};

} // namespace billet::geometry
