// Where the points of the workpiece are against a tool: the closest place of its surface to each,
// and from which gap on a point is open.
//
// Distances are 1-Lipschitz, so a point that was far from a tool and has moved less than that
// distance is open without a query.

#pragma once

#include "contact/term/contact_state.h"

#include <cstddef>
#include <span>

namespace billet::contact {

/// Gap below which a point touches, but for a multiplier: rounding of coordinates [mm].
[[nodiscard]] double touching_gap(const ContactModel& model, std::size_t point);

/// Gap at which a point opens: a multiplier holds it beyond touching [mm].
[[nodiscard]] double opening_gap(const ContactModel& model,
                                 const ToolContact& contact,
                                 std::size_t point,
                                 const AppliedPenalty& penalty);

/// Finds the feet of points on a tool; of those that are known to be open, the gap is infinite.
///
/// @param positions  of the points in space, shape (n_points) [mm]
void search(const ContactModel& model,
            ToolContact& contact,
            const Tool& tool,
            const geometry::Pose& pose,
            std::span<const Vec3> positions,
            const AppliedPenalty& penalty);

} // namespace billet::contact
