// The body of an axisymmetric scene: its section turned about the axis y.
//
// The section is at z = 0 with x as its radius; it is turned from there towards -z, so that the
// opening of a body of 270 degrees lies between x and z. VTK in a header: only for sources of this
// folder.

#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace billet::render {

/// Hexahedra and wedges with the fields of the section; its active vectors turn along.
/// @param section  triangles and quadrilaterals, also quadratic ones
/// @param angle    [degree], up to 360
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> revolved(vtkUnstructuredGrid& section,
                                                            double angle);

/// The faces that lines become, with the fields of their cells.
[[nodiscard]] vtkSmartPointer<vtkPolyData> revolved_lines(vtkPolyData& lines, double angle);

/// Lines of the section where the body begins and ends; none of a closed one.
[[nodiscard]] vtkSmartPointer<vtkPolyData> at_both_ends(vtkPolyData& lines, double angle);

} // namespace billet::render
