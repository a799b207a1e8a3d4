// *AMPLITUDE: a factor as a function of time.

#pragma once

#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"

namespace billet::io {

/// Takes an amplitude that is a table; of another kind is a remark, and the deck does not have it.
/// @throws Error (Fault::geometry) if times do not rise, or for what is no number
void read_amplitude(Deck& deck, const DeckKeyword& keyword);

} // namespace billet::io
