// The bodies of a deck: what hangs together by common nodes, and the faces around it.

#pragma once

#include "io/deck/deck.h"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace billet::io {

/// Elements that hang together.
struct DeckBody {
  std::string name;                 ///< of the smallest set that holds all of it
  std::vector<DeckNumber> elements; ///< increasing
  std::set<DeckNumber> nodes;
  std::string material;                 ///< of the first element, in capitals; empty: none
  const DeckRigidBody* rigid = nullptr; ///< whose nodes or elements are all of it
  std::set<DeckNumber> negative;        ///< facets that surfaces in contact take by their side SNEG
  bool two_sided = false;               ///< of some facets surfaces in contact take both sides
};

/// A face in space as its corners, an edge in the plane as its ends; then the nodes in the middle
/// of its sides. Seen from outside, corners go counter-clockwise; an edge has the body on its left.
struct DeckFace {
  std::vector<DeckNumber> corners;
  std::vector<DeckNumber> middles; ///< none, or one after each corner (of an edge: one)
};

/// Where a node lies.
/// @throws Error (Fault::geometry) if the deck has no such node
[[nodiscard]] const Vec3& deck_point(const Deck& deck, DeckNumber node);

/// Whether an element is part of a body; springs, masses, beams and such are not.
[[nodiscard]] bool has_faces(const DeckElement& element);

/// Whether elements of a type have nodes in the plane only.
[[nodiscard]] bool is_plane_type(const std::string& type);

/// A body of each group of elements that hang together. Springs, masses and such are none.
/// @throws Error (Fault::geometry) for an element without its nodes
[[nodiscard]] std::vector<DeckBody> deck_bodies(const Deck& deck);

/// The faces of an element that a label names: "S3"; empty: all. Shells and rigid facets have one.
[[nodiscard]] std::vector<DeckFace>
faces_of(const Deck& deck, const DeckElement& element, const std::string& label);

/// The faces that belong to one element only; of facets seen from the side that is in contact.
[[nodiscard]] std::vector<DeckFace> boundary_of(const Deck& deck, const DeckBody& body);

} // namespace billet::io
