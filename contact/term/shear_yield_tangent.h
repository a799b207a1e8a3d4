// What friction that follows the strength of the metal beneath adds to the tangent.
//
// The strength changes with the plastic strain at the integration point beneath a contact point,
// and so with the displacements of all nodes of that element. Theory: docs/theory/friction.md
// (F.20).

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

namespace billet::contact {

/// Adds it for all tools.
void add_shear_yield_tangent(const ContactView& contact,
                             const mechanics::Trial& trial,
                             mechanics::System& system);

} // namespace billet::contact
