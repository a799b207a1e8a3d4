// The units that a deck's numbers are in, which it does not say.
//
// A case has mm, N, s, MPa or m, N, s, Pa. A deck in inches and pounds is converted.

#pragma once

#include "io/deck/deck.h"

#include <string_view>
#include <vector>

namespace billet::io {

struct DeckUnits {
  std::string_view name;                          ///< "mm-t-s-N"
  std::string_view system;                        ///< of the case: "mm-N-s-MPa-degC"
  std::string_view length;                        ///< of the case: "mm"
  double length_factor = 1.0, force_factor = 1.0; ///< from the deck to the case
  bool fahrenheit = false;                        ///< temperatures of the deck; else Celsius

  [[nodiscard]] bool is_of_case() const { return length_factor == 1.0 && force_factor == 1.0; }
};

/// Those that are known; the first is the default.
[[nodiscard]] const std::vector<DeckUnits>& deck_units();

/// Converts every number of a deck; angles and times stay.
void to_units_of_case(Deck& deck, const DeckUnits& units);

} // namespace billet::io
