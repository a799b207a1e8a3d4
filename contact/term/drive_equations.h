// The equations of tools that a force or a torque drives: loads, and borders of the tangent. (C.14)

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

namespace billet::contact {

/// Adds what drives the tools, and a stiffness that holds what nothing else holds.
void add_drive_loads(const ContactView& contact,
                     const mechanics::Trial& trial,
                     mechanics::System& system);

/// Adds what contact does over the rates of the tools' free degrees of freedom, and how these
/// change the forces on nodes. Corners add their own.
void add_drive_borders(const ContactView& contact,
                       const mechanics::Trial& trial,
                       mechanics::System& system);

} // namespace billet::contact
