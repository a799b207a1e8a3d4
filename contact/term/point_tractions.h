// The tractions of all points on one tool in a trial.

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <cstddef>

namespace billet::contact {

/// Whether so many points have lost a tool that the trial says nothing about the contact set.
[[nodiscard]] bool
many_parted(const ContactModel& model, const ToolContact& contact, const AppliedPenalty& penalty);

/// Whether a point is kept closed under tension.
[[nodiscard]] bool pulls(const ToolContact& contact);

/// k of the parent element of a point in the trial, of the kind that friction follows [MPa].
[[nodiscard]] double
shear_yield(const ContactModel& model, const Friction& friction, std::size_t point);

/// Whether the slip limit of a point is another one in the last trial than at the pressure that it
/// had when the increment began. (F.3a)
[[nodiscard]] bool had_another_limit(const ContactModel& model,
                                     std::size_t tool,
                                     std::size_t point,
                                     const ToolContact& contact);

/// Finds the tractions from the feet that `search` has found.
///
/// @param keep  what touched stays, if need be under tension (C.15)
/// @return points whose status is not that of the trial before
[[nodiscard]] int evaluate(const ContactModel& model,
                           ContactState& state,
                           std::size_t tool,
                           const mechanics::Trial& trial,
                           const AppliedPenalty& penalty,
                           bool keep);

} // namespace billet::contact
