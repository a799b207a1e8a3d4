// The [remesh] section of a case as settings of a scene.

#pragma once

#include "io/case/case.h"
#include "process/scene/scene.h"

#include <optional>
#include <string>

namespace billet::io {

/// None: the case has no such section.
/// @param place  of the case, for messages
/// @throws Error (Fault::case_file) if the part has what no new mesh can take over
[[nodiscard]] std::optional<process::RemeshSettings>
remesh_settings_of(const Case& content, const process::Part& part, const std::string& place);

} // namespace billet::io
