// When the part is meshed anew. (P.15)

#pragma once

#include "process/remeshing/part_boundary.h"
#include "process/remeshing/remeshing.h"
#include "process/state/run.h"

#include <cstddef>
#include <optional>
#include <string>

namespace billet::process {

/// Notes what remeshing needs to know of the first mesh.
void start_remeshing(Run& run);

/// The side in contact that is the most too long for the tool that it touches; excess 0: there is
/// none.
[[nodiscard]] OutgrownSide most_outgrown_side(const Run& run);

/// Share of the contact that lies on sides longer than the case wants there [-].
[[nodiscard]] double coarse_contact(const Run& run);

/// The tool of whose pressure corners bear the largest share; none: share 0.
[[nodiscard]] CornerLoad most_at_corner(const Run& run);

/// Longest over shortest edge of the most slender element [-].
[[nodiscard]] double aspect(const Run& run);

/// Whether a mesh can be exchanged now, and has been used since it was made.
[[nodiscard]] bool may_remesh(const Run& run);

/// Whether a new mesh would give a zone of contact with too few sides more of them. (P.18)
[[nodiscard]] bool can_be_refined(const Run& run, const ContactZone& zone);

/// Whether a tool's force falls: its zones of contact shrink and need no new mesh.
[[nodiscard]] bool leaves(const Run& run, std::size_t tool);

/// Why the part should be meshed anew now, `left` before the stage ends; none: it need not.
[[nodiscard]] std::optional<std::string> remeshing_due(const Run& run, double left);

} // namespace billet::process
