// Are the cells of a mesh joined as those of one body?
//
// Two cells may meet in a whole side, with the same nodes, one on either side of it. What else
// meshes from files hold gives a run with wrong figures: cells that lie on each other are a body
// twice, sides that only lie next to each other open like cracks.

#pragma once

#include "geometry/base/error.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/mesh/mesh_labels.h"

#include <string>
#include <vector>

namespace billet::mechanics {

/// Cells that cannot be those of one body: more than two at a side, two on the same side of one, or
/// two that share its corners but not the nodes in its middle. Not more than ten of a sort.
///
/// @param labels  by which cells are named
/// @pre the mesh passes `check_mesh`
[[nodiscard]] std::vector<Complaint>
check_connections(const Mesh& mesh, const std::string& place, const MeshLabels& labels = {});

/// Where the mesh may be less joined than it looks: free sides that lie on each other, corners in
/// the middle of other cells' free sides, parts that share no node. A sentence each.
///
/// @pre the mesh passes `check_mesh`
[[nodiscard]] std::vector<std::string> loose_connections(const Mesh& mesh,
                                                         const MeshLabels& labels = {});

} // namespace billet::mechanics
