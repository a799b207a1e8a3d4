// What friction that follows the shear yield stress of the parent element adds to the tangent.
//
// That stress changes with the plastic strain at the integration point closest to a contact point,
// and so with the displacements of all nodes of the element. Theory: docs/theory/friction.md
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
