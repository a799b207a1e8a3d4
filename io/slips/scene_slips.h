// The parts of `scene_slips`; a detail of io/slips.

#pragma once

#include "io/case/case.h"
#include "process/loop/process.h"

#include <string>
#include <vector>

namespace billet::io {

/// Tools that do not arrive, a part that nothing holds or strains.
[[nodiscard]] std::vector<std::string> motion_slips(const Case& content, const process::Run& run);

/// Tools that turn across planes of symmetry.
[[nodiscard]] std::vector<std::string> symmetry_slips(const Case& content, const process::Run& run);

/// Elements that cannot show what is asked of them.
[[nodiscard]] std::vector<std::string> mesh_slips(const Case& content, const process::Run& run);

} // namespace billet::io
