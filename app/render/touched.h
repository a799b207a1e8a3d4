// What tools bear: values of the part where it touches them. VTK in a header: only for sources of
// this folder.

#pragma once

#include "app/render/results.h"
#include "app/render/shown.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace billet::render {

/// The tool in pieces small enough for the field, with the values of the part's surface where that
/// is nearer than a hundredth of `size`, not a number elsewhere.
[[nodiscard]] vtkSmartPointer<vtkPolyData>
with_touched_values(vtkPolyData& tool, const Frame& frame, const Shown& shown, double size);

} // namespace billet::render
