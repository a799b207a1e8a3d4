// What the straight faces of linear elements add to the gaps of their points in the next increment.
// (C.43)

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <cstddef>

namespace billet::contact {

/// Counts the gaps of straight faces on a tool anew from where faces agree at the end of an
/// increment.
void level_faces(const ContactModel& model,
                 ToolContact& contact,
                 std::size_t tool,
                 const mechanics::Trial& trial);

} // namespace billet::contact
