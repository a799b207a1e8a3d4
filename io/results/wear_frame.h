// A tool drawn by the cells of its wear map, with the depth worn away.

#pragma once

#include "contact/tools/tool.h"
#include "contact/wear/wear_map.h"
#include "io/results/vtk_writer.h"

#include <string>

namespace billet::io {

/// Adds the cells of a tool with the fields `wear_depth` and, if strokes are asked for,
/// `wear_depth_extrapolated`. (W.7)
///
/// A shape without end is drawn near the workpiece and as far as it is worn, so that the depths
/// times the areas of the cells are always the volume of the map.
///
/// @param window  about the workpiece: its size around it is near [mm]
/// @param frame   receives points in the tool's frame
void add_wear(const contact::WearMap& map,
              const contact::Tool& tool,
              const Box& window,
              const std::string& unit_of_length,
              SurfaceFrame& frame);

} // namespace billet::io
