// Curves with their axes, drawn without a display.

#pragma once

#include "app/render/options.h"

#include <filesystem>
#include <string>

namespace billet::render {

/// Draws the series of the options, or the forces of its results over the strokes.
/// @returns what each curve is, in words
/// @throws Error  for tables that cannot be read, columns that are not there, a full disk
[[nodiscard]] std::string draw_chart(const Options& options, const std::filesystem::path& picture);

} // namespace billet::render
