// Writing a VTK window as a PNG, all at once. Only for sources of this folder: VTK in a header.

#pragma once

#include <vtkRenderWindow.h>

#include <filesystem>

namespace billet::render {

/// Renders the window and writes it.
/// @throws Error  (Fault::input_output)
void write_picture(vtkRenderWindow& window, const std::filesystem::path& path);

} // namespace billet::render
