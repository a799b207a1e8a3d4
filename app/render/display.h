// A display to draw scenes on, where there is none: Xvfb's.

#pragma once

namespace billet::render {

/// Returns where there is a display; elsewhere the program starts again under xvfb-run. VTK ends a
/// program without a word where it finds no display.
/// @param values  of main
/// @throws Error  (Fault::input_output) where xvfb-run cannot be started
void require_display(char** values);

} // namespace billet::render
