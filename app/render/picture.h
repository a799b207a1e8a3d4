// Writing pictures as PNGs, all at once. Only for sources of this folder: VTK in a header.

#pragma once

#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <filesystem>

namespace billet::render {

/// Scenes are drawn this many times as wide and as high as their picture, whose pixels are means:
/// smooth edges with every driver.
constexpr int samples_a_side = 2;

/// Writes an image, red, green, blue.
/// @throws Error  (Fault::input_output)
void write_picture(vtkImageData& image, const std::filesystem::path& path);

/// Renders the window, whose size is `samples_a_side` times that of the picture.
/// @returns the picture, red, green, blue
[[nodiscard]] vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow& window);

/// Renders the window and writes it.
/// @throws Error  (Fault::input_output)
void write_picture(vtkRenderWindow& window, const std::filesystem::path& path);

} // namespace billet::render
