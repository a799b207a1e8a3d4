// What an engineer asks for first: the force of each tool over its stroke.

#pragma once

#include "app/render/curve.h"

namespace billet::render {

/// Force over stroke of every tool that travels, from the start of the run on: the way along the
/// direction in which the tool has gone farthest, the force of the workpiece against it. Where no
/// tool travels, the magnitudes of all forces over time. In kN and mm where that reads better.
///
/// @param results  folder of a run, which may still be going on
/// @throws Error  (Fault::input_output)
[[nodiscard]] Chart load_stroke(const std::filesystem::path& results);

} // namespace billet::render
