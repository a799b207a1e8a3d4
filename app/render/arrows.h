// A vector field as arrows on the part. VTK in a header: only for sources of this folder.

#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace billet::render {

/// Arrows at points spread evenly over the faces.
/// @param faces    with active vectors at their points
/// @param size     of the part; points are a 25th of it apart [mm]
/// @param longest  length of a vector that is drawn as long as `length` [mm]
/// @return null: there is nothing to draw
[[nodiscard]] vtkSmartPointer<vtkPolyData>
arrows_on(vtkPolyData& faces, double size, double longest, double length);

} // namespace billet::render
