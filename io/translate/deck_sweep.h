// Analytical rigid surfaces that are drawn along a line: *SURFACE, TYPE=CYLINDER.
//
// Lines stay exactly straight. A circle becomes a cylinder. Other arcs are divided into facets so
// fine that curving them (smooth = true) leaves lines and edges as they are.

#pragma once

#include "io/translate/deck_tools.h"

#include <string>

namespace billet::io {

/// A profile drawn along its generator, over the workpiece and a good deal beyond.
[[nodiscard]] DeckToolSurface
swept_surface(const DeckSurface& given, const std::string& name, const DeckSurroundings& around);

} // namespace billet::io
