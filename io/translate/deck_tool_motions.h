// How tools of a case move, by what a deck prescribes of their reference nodes.

#pragma once

#include "io/translate/deck_bodies.h"
#include "io/translate/deck_history.h"

#include <map>
#include <set>
#include <string>

namespace billet::io {

/// Motions as text of a case. What cannot be said becomes a remark of the deck.
class DeckToolMotions {
public:
  /// @param motions  of nodes and sets
  /// @param forces   on nodes and sets
  /// @pre all of them outlive it
  DeckToolMotions(Deck& deck,
                  const std::map<std::string, DeckMotion>& motions,
                  const std::map<std::string, DeckMotion>& forces,
                  bool in_space)
      : deck_(deck), motions_(motions), forces_(forces), in_space_(in_space) {}

  /// "motion = { ... }"; empty: the tool stays.
  [[nodiscard]] std::string
  text(const std::string& tool, const DeckMotion& motion, const DeckRigidBody* rigid);

  /// Whether the force on a node or set drives a tool.
  [[nodiscard]] bool uses_force_on(const std::string& target) const {
    return used_forces_.contains(target);
  }

private:
  void remark(const std::string& text, const std::string& place = {}) {
    deck_.remarks.push_back({place, text});
  }
  [[nodiscard]] int dimension() const { return in_space_ ? 3 : 2; }
  [[nodiscard]] std::string
  translation_text(const std::string& tool, const DeckMotion& motion, const DeckRigidBody* rigid);
  /// Of a tool that a concentrated force on its reference node drives.
  [[nodiscard]] std::string force_text(const std::string& tool, const DeckRigidBody* rigid);
  /// Rotations: components 4 to 6 of the reference node, or 1 to 3 of the rotation node.
  [[nodiscard]] std::string
  rotation_text(const std::string& tool, const DeckMotion& motion, const DeckRigidBody& rigid);

  Deck& deck_;
  const std::map<std::string, DeckMotion>&motions_, &forces_;
  bool in_space_;
  std::set<std::string> used_forces_;
};

} // namespace billet::io
