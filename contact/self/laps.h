// Laps: walls of the part that have met.
//
// Oxide and lubricant stay between such walls, so they remain a defect whether they open again or
// not. Points of the surface that have touched another face keep a mark, which goes with the
// material and over to new meshes. Theory: docs/theory/contact.md (C.56).

#pragma once

#include "contact/self/self_state.h"
#include "geometry/base/vector.h"

#include <span>
#include <vector>

namespace billet::contact {

struct Lap {
  Vec3 place = Vec3::Zero(); ///< in the middle of its walls [mm]
  double since = 0.0;        ///< its first points have met [s]
  double depth = 0.0;        ///< from its mouth to its root, along a wall [mm]
  double area = 0.0;         ///< of one of both walls [mm^2]
  bool closed = false;       ///< its walls touch, at a point at least
};

/// Marks what touches at the end of an increment: a place where marked points touch is theirs, and
/// laps that grow together become the older one.
void mark_laps(const ContactSurface& surface, SelfContactState& state);

/// In the order in which they began.
///
/// @param x  committed positions, shape (n_dofs) [mm]
[[nodiscard]] std::vector<Lap>
laps(const ContactSurface& surface, const SelfContactState& state, std::span<const double> x);

/// Of each point the depth of the lap that it is part of, 0 elsewhere; shape (n_points) [mm].
[[nodiscard]] std::vector<double>
lap_depths(const ContactSurface& surface, const SelfContactState& state, std::span<const double> x);

} // namespace billet::contact
