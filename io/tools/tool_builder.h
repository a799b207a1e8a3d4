// From a case's tool to a rigid tool of the scene.

#pragma once

#include "contact/tools/tool.h"
#include "io/case/case.h"

#include <string>
#include <vector>

namespace billet::io {

/// Builds a tool; what an STL's health check found is added to `notes`.
///
/// @param workpiece_size  diagonal of the workpiece [mm], > 0, to compare an STL with
/// @throws Error with Fault::geometry
[[nodiscard]] contact::Tool build_tool(const Tool& tool,
                                       Analysis analysis,
                                       double workpiece_size,
                                       std::vector<std::string>& notes);

/// A friction of a case as one of contact.
[[nodiscard]] contact::Friction friction_of(const Friction& friction);

/// A place as a rigid placement.
[[nodiscard]] geometry::Pose pose_of(const Place& place);

} // namespace billet::io
