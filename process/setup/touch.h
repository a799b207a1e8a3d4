// Brings tools to first contact with the workpiece: `touch = true`.
//
// Theory: docs/theory/process.md (P.4), geometry.md (G.15), (G.33).

#pragma once

#include "process/scene/scene.h"

namespace billet::process {

/// Longest way of a tool to the workpiece, in sizes of the workpiece.
inline constexpr double most_sizes_to_touch = 100.0;

/// Sets the offset of every tool that is to be brought to touch.
///
/// @throws Error (Fault::geometry, Fault::case_file) naming the tool that stands still or meets
///         nothing
void bring_to_touch(Scene& scene);

} // namespace billet::process
