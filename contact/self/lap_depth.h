// How deep a lap in space goes: along its walls, from its mouth to its root.
//
// A part in the plane shows its walls as lines, whose length is the depth. In space walls are
// surfaces, and which of their edges are mouth and root has to be found. Theory:
// docs/theory/contact.md (C.56).

#pragma once

#include "contact/self/self_state.h"

#include <span>
#include <vector>

namespace billet::contact {

/// The surface of a part in space as a graph: the nodes, and the straight ways between those of a
/// face.
class LapDepth {
public:
  /// @param x  committed positions, shape (n_dofs) [mm]
  LapDepth(const ContactSurface& surface, const SelfContactState& state, std::span<const double> x);

  /// @param lap  its number; points of the surface bear it
  /// @return     [mm]
  [[nodiscard]] double of(int lap) const;

private:
  struct Walls;

  [[nodiscard]] Walls walls(int lap) const;
  [[nodiscard]] double folded(const Walls& walls) const;
  [[nodiscard]] double from_the_mouth(const Walls& walls) const;
  [[nodiscard]] std::size_t pieces(const Walls& walls) const;

  const ContactSurface* surface_;
  const SelfContactState* state_;
  std::vector<Vec3> nodes_;               ///< of the mesh [mm]
  std::vector<Vec3> points_;              ///< contact points [mm]
  std::vector<std::vector<Index>> faces_; ///< at each node
};

} // namespace billet::contact
