#include "io/deck/deck_names.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace billet::io {

namespace {

/// How a thing is called, and what becomes of a line that names one that is not there.
struct ThingWords {
  const char* name;
  const char* number; ///< nullptr: it has none
  const char* consequence;
};

const ThingWords& thing_words(DeckThing thing) {
  static constexpr std::array<ThingWords, 6> all{
      {{"set of nodes", "node", "left out"},
       {"set of elements", "element", "left out"},
       {"surface", nullptr, "left out"},
       {"amplitude", nullptr, "the value is taken as without one"},
       {"material", nullptr, "left out"},
       {"surface interaction", nullptr, "without friction"}}};
  return all[static_cast<std::size_t>(thing)];
}

template <class Map> std::vector<std::string> keys_of(const Map& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const auto& [name, thing] : things)
    names.push_back(name);
  return names;
}

std::vector<std::string> known_names(const Deck& deck, DeckThing thing) {
  switch (thing) {
  case DeckThing::nodes:
    return keys_of(deck.node_sets);
  case DeckThing::elements:
    return keys_of(deck.element_sets);
  case DeckThing::surface:
    return keys_of(deck.surfaces);
  case DeckThing::amplitude:
    return keys_of(deck.amplitudes);
  case DeckThing::material:
    return keys_of(deck.materials);
  case DeckThing::interaction:
    return keys_of(deck.interactions);
  }
  return {};
}

bool deck_has(const Deck& deck, const DeckReference& reference) {
  const std::string name = in_capitals(reference.name);
  const auto has_number = [&](const auto& things) {
    std::int64_t number = 0;
    return parse_integer(name, number) && things.contains(number);
  };
  switch (reference.thing) {
  case DeckThing::nodes:
    return deck.node_sets.contains(name) || has_number(deck.nodes);
  case DeckThing::elements:
    return deck.element_sets.contains(name) || has_number(deck.elements);
  case DeckThing::surface:
    return deck.surfaces.contains(name);
  case DeckThing::amplitude:
    return deck.amplitudes.contains(name);
  case DeckThing::material:
    return deck.materials.contains(name);
  case DeckThing::interaction:
    return deck.interactions.contains(name);
  }
  return false;
}

std::string missing_text(const Deck& deck, const DeckReference& reference) {
  const ThingWords& words = thing_words(reference.thing);
  std::int64_t number = 0;
  const bool is_number = words.number != nullptr && parse_integer(reference.name, number);
  const std::string head =
      reference.name.empty()
          ? fmt::format("*{}: no {} is named", reference.keyword, words.name)
          : fmt::format("*{}: there is no {} {}", reference.keyword,
                        is_number ? words.number : words.name, reference.name.substr(0, 80));
  const std::string remedy =
      is_number || reference.name.empty()
          ? ""
          : suggestion(reference.name, known_names(deck, reference.thing), "the deck has");
  return fmt::format("{}: {}{}", head, words.consequence, remedy.empty() ? "" : "; " + remedy);
}

template <class Things>
std::string missing_members_text(const std::vector<DeckNumber>& members, const Things& there) {
  std::size_t n_missing = 0;
  DeckNumber first = 0;
  for (const DeckNumber member : members)
    if (!there.contains(member) && n_missing++ == 0)
      first = member;
  return n_missing == 0 ? ""
                        : fmt::format("{} of its {} numbers are not there, the first is {}",
                                      n_missing, members.size(), first);
}

} // namespace

void note(Deck& deck, const DeckKeyword& keyword, const std::string& what) {
  deck.remarks.push_back({keyword.place, fmt::format("*{}: {}", keyword.written, what)});
}

void DeckReferences::add(DeckThing thing, const std::string& name, const DeckKeyword& keyword) {
  all_.push_back({thing, name, keyword.written, keyword.place});
}

void DeckReferences::add(DeckThing thing,
                         const DeckKeyword& keyword,
                         std::size_t line,
                         std::size_t i) {
  all_.push_back({thing, keyword.field(line, i), keyword.written, keyword.places[line]});
}

void note_missing(Deck& deck, const std::vector<DeckReference>& references) {
  for (const DeckReference& reference : references)
    if (!deck_has(deck, reference))
      deck.remarks.push_back({reference.place, missing_text(deck, reference)});
}

void note_missing_members(Deck& deck,
                          DeckThing thing,
                          const std::map<std::string, std::string>& places) {
  const bool of_nodes = thing == DeckThing::nodes;
  for (const auto& [name, members] : of_nodes ? deck.node_sets : deck.element_sets) {
    const std::string missing = of_nodes ? missing_members_text(members, deck.nodes)
                                         : missing_members_text(members, deck.elements);
    if (missing.empty())
      continue;
    const auto place = places.find(name);
    deck.remarks.push_back({place == places.end() ? std::string() : place->second,
                            fmt::format("the {} {}: {}", thing_words(thing).name, name, missing)});
  }
}

void require_nodes(const Deck& deck, const std::vector<DeckElementNode>& awaited) {
  constexpr std::size_t most = 10;
  std::vector<Complaint> complaints;
  std::size_t n_missing = 0;
  for (const DeckElementNode& one : awaited)
    if (!deck.nodes.contains(one.node) && ++n_missing <= most)
      complaints.push_back(
          {one.place,
           fmt::format("element {} names node {}, which is not there", one.element, one.node),
           "nodes are read from *NODE only, not made by *NGEN, *NCOPY or *NFILL"});
  if (n_missing > most)
    complaints.push_back({"", fmt::format("{} more such nodes are missing", n_missing - most), ""});
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
}

} // namespace billet::io
