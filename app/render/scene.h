// A frame of the results as a picture: workpiece coloured by a field, its elements, the tools.

#pragma once

#include "app/render/options.h"

namespace billet::render {

/// Draws the frame and writes the picture.
/// @throws Error  for results that cannot be read, a field that is not there, a full disk
void draw_scene(const Options& options);

} // namespace billet::render
