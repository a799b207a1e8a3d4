// Columns of tables as curves.

#pragma once

#include "app/render/options.h"

namespace billet::render {

/// Draws the series of the options and writes the picture.
/// @throws Error  for tables that cannot be read, columns that are not there, a full disk
void draw_chart(const Options& options);

} // namespace billet::render
