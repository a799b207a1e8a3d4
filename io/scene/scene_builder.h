// From a validated case to a scene: meshes made or read, surfaces built, names resolved.

#pragma once

#include "io/case/case.h"
#include "io/scene/solid_meshing.h"
#include "process/scene/scene.h"

#include <string>
#include <vector>

namespace billet::io {

/// A scene and what the user should know about how it came about.
struct BuiltScene {
  process::Scene scene;
  std::vector<std::string> notes; ///< for the log: mesh and STL reports, what is active
};

/// Builds the scene of a case.
///
/// @param place  what complaints about the case's contents begin with (the case file)
/// @param say    called before each step that takes a while, with what it is; may be empty
/// @throws Error with Fault::geometry for a mesh or surface that cannot be used, Fault::case_file
///         for a name or place that finds nothing
[[nodiscard]] BuiltScene
build_scene(const Case& content, const std::string& place, const Say& say = {});

} // namespace billet::io
