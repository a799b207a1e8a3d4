// Looks at a .vtu before VTK's reader does, which stops the program over some kinds of damage.

#pragma once

#include <filesystem>
#include <string_view>

namespace billet::io {

/// Refuses counts a file of this size cannot hold, arrays without a known type, and headers of
/// compressed data that make VTK 9.1 divide by zero or ask for any amount of memory.
/// @throws Error  (Fault::geometry)
void require_plausible_vtu(std::string_view content, const std::filesystem::path& path);

} // namespace billet::io
