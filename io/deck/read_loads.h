// Supports and loads of a deck: *BOUNDARY, *CLOAD, *DLOAD and *DSLOAD.

#pragma once

#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"
#include "io/deck/deck_names.h"

#include <cstddef>

namespace billet::io {

/// Adds to the last step, or to what holds before the first.
class DeckLoads {
public:
  DeckLoads(Deck& deck, DeckReferences& references) : deck_(deck), references_(references) {}

  /// False: the keyword is no support or load.
  /// @throws Error (Fault::geometry) for data that cannot be
  bool take(const DeckKeyword& keyword);

  /// Once the deck is read: in one with steps, loads before the first of them belong to none.
  void finish();

private:
  [[nodiscard]] DeckStep& now();
  void refer_to_amplitude(const DeckKeyword& keyword);
  void boundary(const DeckKeyword& keyword);
  void boundary_by_number(const DeckKeyword& keyword, std::size_t line, DeckCondition condition);
  void forces(const DeckKeyword& keyword);
  void pressures(const DeckKeyword& keyword);
  /// False: it has no direction, and is left out.
  bool traction(const DeckKeyword& keyword, std::size_t line, DeckPressure given);
  void gravity(const DeckKeyword& keyword, std::size_t line);
  void body_force(const DeckKeyword& keyword, std::size_t line, const std::string& label);

  Deck& deck_;
  DeckReferences& references_;
};

} // namespace billet::io
