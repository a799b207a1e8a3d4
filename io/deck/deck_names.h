// Names and numbers that lines of a deck refer to, and whether there is what they name.
//
// What a name stands for may follow the line that says it, so names are looked for once the whole
// deck is read. A miss is a remark at that line; an element without its nodes is an error.

#pragma once

#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace billet::io {

/// Says what of a keyword is left out, or means something else here.
void note(Deck& deck, const DeckKeyword& keyword, const std::string& what);

/// Sets of nodes and elements stand for a number as well.
enum class DeckThing { nodes, elements, surface, amplitude, material, interaction };

struct DeckReference {
  DeckThing thing;
  std::string name;
  std::string keyword; ///< that refers to it, as written
  std::string place;
};

/// What the lines of a deck refer to, in their order.
class DeckReferences {
public:
  /// Something that a keyword names as a whole.
  void add(DeckThing thing, const std::string& name, const DeckKeyword& keyword);
  /// Something that a field of a data line names.
  void add(DeckThing thing, const DeckKeyword& keyword, std::size_t line, std::size_t i);

  [[nodiscard]] const std::vector<DeckReference>& all() const { return all_; }

private:
  std::vector<DeckReference> all_;
};

/// A node of an element that was not there when the element was read.
struct DeckElementNode {
  DeckNumber element;
  DeckNumber node;
  std::string place;
};

/// A remark for each reference to what the deck does not have.
void note_missing(Deck& deck, const std::vector<DeckReference>& references);

/// A remark for each set that has nodes or elements that are not there.
/// @param places  of the first lines of sets of nodes, or of elements, by name in capitals
void note_missing_members(Deck& deck,
                          DeckThing thing,
                          const std::map<std::string, std::string>& places);

/// @throws Error (Fault::geometry) with element, node and line for nodes that are still missing
void require_nodes(const Deck& deck, const std::vector<DeckElementNode>& awaited);

} // namespace billet::io
