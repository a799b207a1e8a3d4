// Which files make up the frame to draw, and what their field data say. VTK in a header: only for
// sources of this folder.

#pragma once

#include "app/render/options.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <map>
#include <string>

namespace billet::render {

/// A frame in memory.
struct Frame {
  vtkSmartPointer<vtkUnstructuredGrid> workpiece;
  std::map<std::string, vtkSmartPointer<vtkPolyData>> tools; ///< by name
  std::string title;                                         ///< of the results
  double time = 0.0;                                         ///< [s]
};

/// Reads the frame nearest to the time asked for.
/// @throws Error  (Fault::input_output)
[[nodiscard]] Frame read_frame(const Options& options);

/// The text "NAME: text" in the field data; empty if it is not there.
[[nodiscard]] std::string text_in(vtkDataObject& data, const std::string& name);

} // namespace billet::render
