// What is written around a scene: title, captions, the scale of colours. VTK in a header: only for
// sources of this folder.

#pragma once

#include "app/render/colours.h"
#include "app/render/shown.h"

#include <vtkLookupTable.h>
#include <vtkRenderer.h>

#include <array>
#include <string>

namespace billet::render {

/// Where things are in the picture, as shares of it.
struct Sheet {
  std::array<int, 2> size{2400, 1800}; ///< of the window, `samples_a_side` times the picture's
  int font = 36;                       ///< [pixels of the window]
  double right = 0.85;                 ///< where the scale of colours begins
  double top = 0.94, bottom = 0.06;    ///< of the scene

  Sheet(const std::array<int, 2>& size, bool with_scale, int caption_lines);
};

/// A text in a renderer over the whole picture, in letters that are small enough for its width.
/// @param place  left or middle, and foot, of the text as shares of the picture
void add_text(vtkRenderer& overlay,
              const std::string& text,
              const std::array<double, 2>& place,
              int font,
              double width,
              bool centred);

/// The scale of colours, in a renderer of its own.
void add_scale(vtkRenderer& margin,
               vtkLookupTable& map,
               const Shown& shown,
               const ColourRange& range,
               const Sheet& sheet,
               const std::optional<int>& bands);

} // namespace billet::render
