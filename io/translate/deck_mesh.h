// The mesh of a deck's workpiece as a case can have it: elements of one kind that is available.
//
// Elements of one available kind stay what they are. Linear triangles and tetrahedra, and elements
// with incompatible modes, get nodes in the middles of their edges. Wedges, and elements of several
// kinds, are divided into triangles or tetrahedra with such nodes.

#pragma once

#include "io/translate/deck_bodies.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

struct DeckMesh {
  std::string element; ///< of the case: "hex20"
  std::string type;    ///< of the mesh's file: "C3D20"
  std::map<DeckNumber, Vec3> nodes;
  std::vector<std::pair<DeckNumber, std::vector<DeckNumber>>> elements; ///< numbers, nodes
  std::string remark; ///< how it differs from the deck's; empty: it does not

  /// A set of the deck's nodes on this mesh: without those that are not there any more, and with
  /// the new ones in the middles of faces' edges that are all in the set. Where the set has no
  /// whole face, of edges on the surface.
  [[nodiscard]] std::vector<DeckNumber> set_of(const std::vector<DeckNumber>& nodes) const;

  /// Sets of nodes for faces of the deck, by their corners. A load on a set of nodes acts on every
  /// face of the surface that is all in it, so faces that would take in another one with them are
  /// in different sets.
  [[nodiscard]] std::vector<std::vector<DeckNumber>>
  sets_of_faces(const std::vector<std::set<DeckNumber>>& faces) const;

  using Edge = std::pair<DeckNumber, DeckNumber>; ///< the lower number first
  std::map<Edge, DeckNumber> middles;             ///< nodes between two corners
  std::map<Edge, DeckNumber> added;               ///< those that the deck does not have
  std::vector<std::vector<DeckNumber>> boundary;  ///< corners of faces
};

/// @throws Error (Fault::geometry) for elements that are none of a solid's
[[nodiscard]] DeckMesh mesh_of(const Deck& deck, const DeckBody& body);

} // namespace billet::io
