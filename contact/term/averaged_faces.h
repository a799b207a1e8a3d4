// Pressure-averaged faces, of quadratic elements: pressure shall not oscillate from point to point
// there, so their points press by what the gaps of all of them say. (C.45)

#pragma once

#include "contact/term/contact_state.h"

#include <cstddef>

namespace billet::contact {

/// What the trial's gaps press a face with, where its pressures follow from all of them; null: each
/// from its own.
[[nodiscard]] const FacePressure* averaged_pressure(const ToolContact& contact, Index face);

/// Pressure of a point of such a face in the trial.
[[nodiscard]] SharedPressure
shared_pressure(const ContactModel& model, const FacePressure& face, std::size_t point);

/// Gap beyond which a point of such a face does not press, whatever the others do [mm].
[[nodiscard]] double
opening_gap_of_averaged(const ContactModel& model, const PointHistory& history, std::size_t point);

/// Chooses a tool's faces whose pressure is averaged in the next increment.
void choose_averaged_faces(const ContactModel& model, ContactState& state, std::size_t tool);
/// None is any more.
void forget_averaged_faces(ToolContact& contact);

/// Finds what a trial's gaps press such faces with.
///
/// @param keep  what touched stays, if need be under tension (C.15)
void press_averaged_faces(const ContactModel& model,
                          const PenaltyFactors& factors,
                          const AppliedPenalty& penalty,
                          bool keep,
                          ToolContact& contact);

/// What the trial adds to the gap of a point of such a face, were its penalty its own [mm].
///
/// @param normal  penalty [MPa/mm]
[[nodiscard]] double gap_correction(const ToolContact& contact, std::size_t point, double normal);

/// How deep a point of the trial lies in a tool, as contact counts its gap [mm].
///
/// @param normal  penalty [MPa/mm]
[[nodiscard]] double pressed_depth(const ContactModel& model,
                                   const ToolContact& contact,
                                   std::size_t point,
                                   double normal);

} // namespace billet::contact
