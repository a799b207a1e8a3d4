// A frame of the results as a picture: workpiece coloured by a field, its elements, the tools.

#pragma once

#include "app/render/options.h"

#include <filesystem>
#include <string>

namespace billet::render {

/// Draws the frame and writes the picture.
/// @returns what its colours are, in words
/// @throws Error  for results that cannot be read, a field that is not there, a full disk
[[nodiscard]] std::string draw_scene(const Options& options, const std::filesystem::path& picture);

} // namespace billet::render
