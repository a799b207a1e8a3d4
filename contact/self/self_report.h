// What contact of the part with itself says: its points, and the places where walls have met.

#pragma once

#include "contact/self/self_contact_term.h"
#include "contact/term/contact_report.h"

#include <span>
#include <vector>

namespace billet::contact {

/// A place where two walls of the part touch in the committed state.
struct MeetingWalls {
  Vec3 place = Vec3::Zero();  ///< in the middle of the area [mm]
  double since = 0.0;         ///< the first of its points has touched without a break [s]
  double area = 0.0;          ///< of one of both walls [mm^2]
  double length = 0.0;        ///< of one of both walls, along the section; in space 0 [mm]
  double mean_pressure = 0.0; ///< [MPa]
};

/// Places whose faces hang together count once, in the order of their first points.
///
/// @param x  committed positions, shape (n_dofs) [mm]
[[nodiscard]] std::vector<MeetingWalls> meeting_walls(const ContactSurface& surface,
                                                      const SelfContactState& state,
                                                      std::span<const double> x);

/// Adds what points bear on other faces of the part to what they bear on tools.
///
/// @param results  shape (n_points)
void add_self_contact(const SelfContactState& state, std::span<PointResult> results);

} // namespace billet::contact
