// A case from a deck: its text, its mesh and its tools, and what of the deck they leave out.

#pragma once

#include "io/translate/deck_tools.h"

#include <string>
#include <vector>

namespace billet::io {

/// The units that a deck's numbers are in, which it does not say.
struct DeckUnits {
  std::string_view name;   ///< "mm-t-s-N"
  std::string_view system; ///< of the case: "mm-N-s-MPa-degC"
  std::string_view length; ///< "mm"
};

/// Those that a case may have; the first is the default.
[[nodiscard]] const std::vector<DeckUnits>& deck_units();

struct DeckCase {
  std::vector<DeckFile> files; ///< case.toml first
  std::vector<DeckRemark> remarks;
};

/// @param name  of the deck, for the head of the case
/// @throws Error (Fault::geometry) if there is nothing that a workpiece could be
[[nodiscard]] DeckCase case_of(Deck deck, const DeckUnits& units, const std::string& name);

} // namespace billet::io
