// How the faces of a tool turn from one to the next, and whether they stand for a curved surface.
//
// Elements on a curved surface turn alike from each to the next, and are about as wide. An edge
// with such turns on both of its sides lies within a curved surface; so does one that is followed
// by such an edge, as where a fillet ends in a plane. Any other edge stands alone: it is meant to
// be there, however blunt it is.

#pragma once

#include "io/translate/deck_bodies.h"

#include <vector>

namespace billet::io {

/// Turns below those of sharp edges.
struct FaceTurns {
  double curved = 0.0; ///< largest between faces of a curved surface [degrees]; 0: there is none
  double alone = 0.0;  ///< smallest of an edge that stands alone [degrees]; 0: there is none

  /// Whether there is a curved surface, and no edge would be lost by curving it.
  [[nodiscard]] bool is_curved() const { return curved > 0.0; }
  /// Between the turns of curved surfaces and those of edges. [degrees]
  [[nodiscard]] double feature_angle() const;
};

/// Edges that turn by more are sharp. [degrees]
inline constexpr double sharp_turn = 30.0;

[[nodiscard]] FaceTurns turns_between(const Deck& deck, const std::vector<DeckFace>& faces);

} // namespace billet::io
