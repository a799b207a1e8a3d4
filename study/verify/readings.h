// What problems read off a run.

#pragma once

#include "process/state/run.h"

#include <string>
#include <vector>

namespace billet::study {

/// A point of the contact surface at the end of an increment.
struct ContactReading {
  Vec3 position;   ///< [mm]
  double area;     ///< that it stands for: of the full turn, or per thickness [mm^2]
  double pressure; ///< [MPa]
};

/// All points of the contact surface. @pre the run has tools
[[nodiscard]] std::vector<ContactReading> contact_readings(const process::Run& run);

/// Force of the workpiece on a tool [N]. @pre the run has it
[[nodiscard]] Vec3 force_on_tool(const process::Run& run, std::size_t tool = 0);

/// Sum of the supports' forces on a node set along an axis [N].
/// @throws std::out_of_range for a set that the mesh does not have
[[nodiscard]] double reaction(const process::Run& run, const std::string& set, int axis);

/// Where a node is [mm].
[[nodiscard]] Vec3 position(const process::Run& run, mechanics::Index node);

/// The node that was nearest to a place when the mesh was made.
[[nodiscard]] mechanics::Index node_at(const process::Run& run, const Vec3& place);

/// Largest coordinate of the nodes along an axis [mm].
[[nodiscard]] double largest_coordinate(const process::Run& run, int axis);

} // namespace billet::study
