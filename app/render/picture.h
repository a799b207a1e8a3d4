// Writing pictures as PNGs, all at once. Only for sources of this folder: VTK in a header.

#pragma once

#include <vtkImageData.h>
#include <vtkRenderWindow.h>

#include <filesystem>

namespace billet::render {

/// Writes an image, red, green, blue.
/// @throws Error  (Fault::input_output)
void write_picture(vtkImageData& image, const std::filesystem::path& path);

/// Renders the window and writes it.
/// @throws Error  (Fault::input_output)
void write_picture(vtkRenderWindow& window, const std::filesystem::path& path);

} // namespace billet::render
