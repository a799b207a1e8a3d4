// The supports of a deck's workpiece as tables of a case.

#pragma once

#include "io/translate/deck_bodies.h"
#include "io/translate/deck_history.h"

#include <map>
#include <string>
#include <vector>

namespace billet::io {

class DeckSupports {
public:
  /// Nodes of the case's mesh by the names of their sets.
  using NodeSets = std::map<std::string, std::vector<DeckNumber>>;

  /// @param motions  what the deck prescribes, by target in capitals
  /// @pre they outlive it
  DeckSupports(Deck& deck,
               const DeckBody& part,
               const std::map<std::string, DeckMotion>& motions,
               int dimension)
      : deck_(deck), part_(part), motions_(motions), dimension_(dimension) {}

  /// The [[support]] tables, with remarks in the deck.
  ///
  /// @param sets  gets those that the tables name
  [[nodiscard]] std::string text(NodeSets& sets);

private:
  struct SingleNodes;

  [[nodiscard]] std::vector<DeckNumber> own_nodes(const std::string& target) const;
  [[nodiscard]] std::string set_named(const std::string& wish, std::vector<DeckNumber> nodes);
  [[nodiscard]] std::string support_text(const std::string& set, const DeckMotion& motion) const;
  [[nodiscard]] static std::vector<SingleNodes> grouped(const std::vector<SingleNodes>& all);
  [[nodiscard]] std::string clamped_nodes(const DeckRigidBody& rigid);

  Deck& deck_;
  const DeckBody& part_;
  const std::map<std::string, DeckMotion>& motions_;
  int dimension_;
  NodeSets* sets_ = nullptr;
};

} // namespace billet::io
