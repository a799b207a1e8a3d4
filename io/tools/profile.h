// Profile files: the outline of a die as lines and arcs, in TOML.
//
//   closed = true                       # default false
//   start  = [0, 0]
//   [[segment]]                         # a line
//   to     = [10, 0]
//   [[segment]]                         # an arc: radius > 0 turns left, < 0 turns right
//   to     = [12, 2]
//   radius = 2
//   large  = false                      # true: the longer of the two arcs
// or just  points = [[x, y], ...]  in place of start and segments. The tool lies on the left of the
// direction of travel (geometry/surfaces/profile.h). Units: those of the case.

#pragma once

#include "geometry/surfaces/profile.h"

#include <filesystem>

namespace billet::io {

/// @throws Error(Fault::geometry) with every complaint of the file, each with file:line:column
[[nodiscard]] geometry::Profile read_profile(const std::filesystem::path& path);

} // namespace billet::io
