// A film of all frames: a GIF, an MP4 or a series of PNGs.

#pragma once

#include "app/render/options.h"

#include <filesystem>
#include <string>

namespace billet::render {

/// Draws the frames and writes the film, all at once; a series of PNGs one after another.
/// @returns how many frames it has and what the colours are, in words
/// @throws Error  for results that cannot be read, a field that is not there, a full disk, and
///                (Fault::input_output) where the program ffmpeg is not there or fails
[[nodiscard]] std::string draw_film(const Options& options, const std::filesystem::path& file);

} // namespace billet::render
