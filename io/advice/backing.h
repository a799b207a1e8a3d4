// What stands behind the ends of a part, and whether it is solid between them; a detail of
// io/advice.

#pragma once

#include "io/advice/part_ends.h"
#include "process/scene/scene.h"

#include <span>
#include <vector>

namespace billet::io {

/// Those of some nodes that lie at a tool which stands at an end of the part at the start and faces
/// it.
[[nodiscard]] std::vector<Vec3>
nodes_at_tools(const process::Scene& scene, int axis, End end, std::span<const Vec3> nodes);

/// Whether what stands behind one end and behind the other lie opposite each other: else the part
/// is bent, not pressed.
///
/// @param a, b    nodes at the ends
/// @param height  from end to end [mm]
[[nodiscard]] bool
are_opposite(std::span<const Vec3> a, std::span<const Vec3> b, int axis, double height);

/// Volume of the part over that of its box [-], in the plane area over area.
[[nodiscard]] double solid_share(const process::Part& part);

} // namespace billet::io
