// What a deck prescribes, as functions of the time of the whole run.
//
// A value without an amplitude is reached evenly over its step, one with an amplitude goes along it
// between the ends of the step, and stays there; an amplitude over the time of the run (TIME=TOTAL
// TIME) and a velocity go on until a later step prescribes the same again. Where an amplitude does
// not begin where the step before ended, the deck jumps: a remark says so, and the jump is drawn
// over a thousandth of the step.

#pragma once

#include "io/deck/deck.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

/// Points (time, value); times increase, the first is 0.
using DeckHistory = std::vector<std::pair<double, double>>;

/// What is prescribed of one target, by component 1 to 6.
struct DeckMotion {
  std::map<int, DeckHistory> components;
  std::string place; ///< of the first line that says so
};

/// End of the last step.
[[nodiscard]] double end_of(const Deck& deck);

/// Displacements by target, in capitals. Supports that a step releases are kept; a remark says so.
[[nodiscard]] std::map<std::string, DeckMotion> prescribed_motions(Deck& deck);

/// Concentrated forces by target, in capitals. Those that a step takes back (OP=NEW) end at 0.
[[nodiscard]] std::map<std::string, DeckMotion> concentrated_forces(Deck& deck);

/// A pressure as it acts in a step, and after it.
struct DeckPressureHistory {
  DeckPressure pressure;
  DeckHistory history;
};
[[nodiscard]] std::vector<DeckPressureHistory> pressure_histories(Deck& deck);

/// Whether a history is zero throughout.
[[nodiscard]] bool is_zero(const DeckHistory& history);

/// What is prescribed of a single node by any target that holds it.
[[nodiscard]] DeckMotion
motion_of_node(const Deck& deck, const std::map<std::string, DeckMotion>& all, DeckNumber node);

} // namespace billet::io
