// Whether the workpiece answers the loads that drive tools: what a run that stops there can tell.
//
// Contact only pushes. A load that takes its tool off the part meets nothing, and a torque is
// balanced by friction or by a shape alone; no increment is short enough for either.
//
// Units: N, mm. Theory: docs/theory/process.md (P.33).

#pragma once

#include "contact/term/contact_term.h"
#include "geometry/base/time_function.h"

#include <cstddef>
#include <span>
#include <string>

namespace billet::process {

/// A load on a tool, and what the workpiece answered it with in the last try.
struct DriveState {
  enum class Contact { presses, pulls_off, none };

  std::size_t tool = 0;
  bool turns = false;  ///< it is a torque about an axis; else a force along one
  double load = 0.0;   ///< [N], or [N mm]
  double answer = 0.0; ///< of contact against it [N], or [N mm]
  Contact contact = Contact::presses;

  /// Whether most of the load is borne.
  [[nodiscard]] bool balanced() const;
};

/// The first value that is not zero from a time on; where a load begins it may be nothing yet.
[[nodiscard]] double first_load(const TimeFunction& load, double time);

/// What a load along a direction does with the contact of a tool.
///
/// @param history    of its points, shape (n_points)
/// @param direction  unit vector in the tool's frame
[[nodiscard]] DriveState::Contact contact_under(std::span<const contact::PointHistory> history,
                                                const Vec3& direction);

/// What is wrong with it, for the reason of a failure; empty: nothing that is known.
[[nodiscard]] std::string complaint_about(const DriveState& drive, const std::string& tool);

} // namespace billet::process
