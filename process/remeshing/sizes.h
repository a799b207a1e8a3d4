// Sizes that the part would be meshed with now. (P.14), (P.18), (P.22)

#pragma once

#include "geometry/mesh3d/solid_remesher.h"
#include "process/remeshing/part_boundary.h"
#include "process/state/run.h"

#include <functional>
#include <vector>

namespace billet::process {

/// What the case asks for, and what it leaves open from the mesh at the start [mm].
struct UsualSizes {
  double usual, at_contact, min, max;
  ZoneSizes zones;
};
[[nodiscard]] UsualSizes usual_sizes(const Run& run);

/// The shortest edge that a new mesh can be asked for; in the plane in a zone of contact. [mm]
[[nodiscard]] double shortest_size(const Run& run);

/// Sizes that the part would be meshed with now, in the plane; the scene has settings for that.
[[nodiscard]] geometry::RemeshSizes remesh_sizes(const Run& run);

/// The same in space.
[[nodiscard]] geometry::SolidSizes solid_sizes(const Run& run);

/// Sizes that follow how the rate of flow changes from place to place. (P.22)
[[nodiscard]] std::vector<geometry::SizeAt> sizes_for_flow(const Run& run);

} // namespace billet::process
