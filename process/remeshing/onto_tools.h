// Nodes of a new boundary projected onto the tools that they touch. (P.14)

#pragma once

#include "contact/surface/contact_surface.h"
#include "process/state/run.h"

#include <optional>

namespace billet::process {

/// How a node of the new boundary may go to a tool.
struct WayToTool {
  double most_gap = 0.0; ///< that it is off a tool that it touches [mm]
  double depth = 0.0;    ///< in the tool at which it may stay, as its pressure needs [mm]
  unsigned fixed = 0;    ///< components that stay: 1 for x, 2 for y, 4 for z
};

/// A node of the new boundary put on the tools that old contact points next to it touch, and out of
/// the others.
///
/// @param tool  the only one that may be touched, -1: none; empty: any
/// @pre there are tools
[[nodiscard]] Vec3 projected_onto_tools(const Run& run,
                                        const contact::PointSource& source,
                                        const Vec3& x,
                                        std::optional<int> tool,
                                        const WayToTool& way);

} // namespace billet::process
