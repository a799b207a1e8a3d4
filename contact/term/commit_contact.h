// The end of an increment: the trial assembled last becomes the committed state, forces and works
// are summed up, and what holds faces in the next increment is set.

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

namespace billet::contact {

/// @pre `trial` is the one assembled last
void commit_contact(const ContactModel& model, ContactState& state, const mechanics::Trial& trial);

} // namespace billet::contact
