// Whether an increment carries the workpiece through a tool.
//
// Contact looks at the end of an increment: a node that has come through a thin die is free there,
// and one that is nearer to its back is pushed out on the wrong side. The run loop asks here twice:
// about the first guess, before anything is solved, and about the converged result.
//
// Theory: docs/theory/process.md (P.9).

#pragma once

#include "contact/term/contact_term.h"
#include "geometry/base/outcome.h"
#include "mechanics/equilibrium/force_term.h"

#include <span>

namespace billet::process {

/// Whether no node or contact point passes through a tool; else which, and where. Tools that do not
/// act at the end of the increment are left out.
Outcome<Done> check_passages(std::span<const contact::Tool> tools,
                             const contact::ContactSurface& surface,
                             const contact::ContactTerm& contact,
                             const mechanics::Trial& trial);

} // namespace billet::process
