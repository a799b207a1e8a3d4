// How a tool's material moves in an increment.

#pragma once

#include "contact/term/contact_model.h"
#include "mechanics/equilibrium/force_term.h"

#include <array>
#include <cstddef>

namespace billet::contact {

/// From where it is at one time.
struct ToolWay {
  Vec3 shift; ///< [mm]
  Vec3 turn;  ///< about the axis [rad]
  Vec3 axis;  ///< a point on it at that time [mm]

  /// Along the arc [mm].
  [[nodiscard]] Vec3 of(const Vec3& x) const { return shift + turn.cross(x - axis); }
};

/// From where it is at the beginning of the increment and at its end.
[[nodiscard]] std::array<ToolWay, 2>
tool_ways(const ContactModel& model, std::size_t tool, const mechanics::Trial& trial);

} // namespace billet::contact
