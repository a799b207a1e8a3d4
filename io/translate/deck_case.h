// A case from a deck: its text, its mesh and its tools, and what of the deck they leave out.

#pragma once

#include "io/translate/deck_tools.h"
#include "io/translate/deck_units.h"

#include <string>
#include <vector>

namespace billet::io {

struct DeckCase {
  std::vector<DeckFile> files; ///< case.toml first
  std::vector<DeckRemark> remarks;
};

/// @param name  of the deck, for the head of the case
/// @throws Error (Fault::geometry) if there is nothing that a workpiece could be
[[nodiscard]] DeckCase case_of(Deck deck, const DeckUnits& units, const std::string& name);

} // namespace billet::io
