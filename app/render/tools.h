// Tools as they are drawn: near the part, as a whole like it, with their sharp edges. VTK in a
// header: only for sources of this folder.

#pragma once

#include "app/render/body.h"
#include "geometry/base/box.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace billet::render {

/// A tool: faces in space, lines in the plane.
struct DrawnTool {
  vtkSmartPointer<vtkPolyData> faces;
  vtkSmartPointer<vtkPolyData> lines; ///< of the plane; of faces their sharp edges
};

/// The tools of a frame.
/// @param window  what is drawn of them, in coordinates of the section where a body is revolved
/// @param part    faces of the part: where the field is one that tools have by touching it
[[nodiscard]] std::vector<DrawnTool>
tools_of(const Frame& frame, const Shown& shown, const Completion& completion, const Box& window);

} // namespace billet::render
