// Finds pockets: parts of the free surface whose ends lie on one tool, or on a tool and a line of
// symmetry, so that what is between metal and tool has no way out. (C.57)

#pragma once

#include "contact/term/contact_state.h"
#include "contact/trapped/pocket.h"
#include "contact/trapped/tool_line.h"

#include <span>
#include <vector>

namespace billet::contact {

/// All pockets in the committed state of contact. @pre in the plane
///
/// @param x  committed positions [mm]
[[nodiscard]] std::vector<PocketPlace> find_pockets(const ContactView& contact,
                                                    std::span<const SymmetryLine> lines,
                                                    std::span<const double> x,
                                                    double time);

} // namespace billet::contact
