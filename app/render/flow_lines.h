// Lines of material: where the metal is that lay on straight lines before the run.
//
// A forging's flow lines, as etching shows them. Each is a line of equal first height or of equal
// first distance from the axis; remeshing does not break them, for the displacement is carried from
// mesh to mesh.

#pragma once

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace billet::render {

/// Contours of the two first coordinates, evenly spread between their extremes.
///
/// @param faces  triangles with the point field "displacement"
/// @param count  lines of each of the two families, > 0
/// @return null: the field is not there
[[nodiscard]] vtkSmartPointer<vtkPolyData> flow_lines(vtkPolyData& faces, int count);

} // namespace billet::render
