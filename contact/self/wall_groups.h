// Which points of the surface that touch other faces belong to the same place.

#pragma once

#include "contact/self/self_state.h"

#include <vector>

namespace billet::contact {

/// Of each point the group that it belongs to, -1 of an open one; shape (n_points). Points are of
/// one group if the faces that they are of, and that they touch, hang together by nodes.
[[nodiscard]] std::vector<Index> wall_groups(const ContactSurface& surface,
                                             const SelfContactState& state);

} // namespace billet::contact
