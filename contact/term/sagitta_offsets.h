// What the faces of linear elements add to the gaps of their points in the next increment: their
// sagitta offsets. (C.43)

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <cstddef>

namespace billet::contact {

/// Sets the offsets on a tool anew, so that gaps count from where faces agree at the end of an
/// increment.
void set_sagitta_offsets(const ContactModel& model,
                         ToolContact& contact,
                         std::size_t tool,
                         const mechanics::Trial& trial);

} // namespace billet::contact
