// The loads of a deck's workpiece as tables of a case: pressures, tractions, forces per volume.

#pragma once

#include "io/translate/deck_bodies.h"
#include "io/translate/deck_mesh.h"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace billet::io {

/// What axes a case has.
struct DeckSpace {
  bool in_space;
  bool axisymmetric;
};

class DeckForces {
public:
  /// Nodes of the case's mesh by the names of their sets.
  using NodeSets = std::map<std::string, std::vector<DeckNumber>>;

  /// @pre what it is given outlives it
  DeckForces(Deck& deck, const DeckBody& part, const DeckMesh& mesh, const DeckSpace& space)
      : deck_(deck), part_(part), mesh_(mesh), space_(space) {}

  /// The [[load]] tables, with remarks in the deck.
  ///
  /// @param density  of the workpiece; none: it has none
  /// @param sets     gets those that the tables name
  [[nodiscard]] std::string text(const std::optional<double>& density, NodeSets& sets);

private:
  void remark(const std::string& text, const std::string& place);
  /// The corners of the faces of a surface, or of elements, on the workpiece.
  [[nodiscard]] std::vector<std::set<DeckNumber>> loaded_faces(const DeckPressure& pressure) const;
  /// Components of a traction share their set.
  [[nodiscard]] std::string set_of_traction(const std::vector<DeckNumber>& nodes);
  /// The axis of a label in this case, 0 to 2; none: it has none.
  [[nodiscard]] std::optional<int> axis_of(const std::string& label) const;
  [[nodiscard]] std::string body_force_text();
  [[nodiscard]] std::string gravity_text(const std::optional<double>& density);
  /// Amplitudes of forces per volume, and the step they begin in, are not translated.
  void note_whole_time(const std::string& label,
                       const std::string& amplitude,
                       std::size_t step,
                       const std::string& place);
  void note_whole_part(const std::string& label, const std::string& set, const std::string& place);

  Deck& deck_;
  const DeckBody& part_;
  const DeckMesh& mesh_;
  DeckSpace space_;
  NodeSets* sets_ = nullptr;
  int n_pressures_ = 0, n_tractions_ = 0;
};

} // namespace billet::io
