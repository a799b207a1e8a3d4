// Keywords of materials.

#pragma once

#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"

#include <string>

namespace billet::io {

/// Takes *MATERIAL and what belongs to the last of them.
class DeckMaterials {
public:
  explicit DeckMaterials(Deck& deck) : deck_(deck) {}

  /// False: the keyword is none of a material.
  /// @throws Error (Fault::geometry) for data that cannot be
  bool take(const DeckKeyword& keyword);

private:
  void material(const DeckKeyword& keyword);
  void elastic(const DeckKeyword& keyword);
  void plastic(const DeckKeyword& keyword);
  void curve(const DeckKeyword& keyword);
  void johnson_cook(const DeckKeyword& keyword);
  void rate(const DeckKeyword& keyword);
  void density(const DeckKeyword& keyword);

  Deck& deck_;
  DeckMaterial* current_ = nullptr; ///< that the keywords belong to
};

} // namespace billet::io
