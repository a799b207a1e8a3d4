// What is taken away in front of planes, and the faces that this lays open. VTK in a header: only
// for sources of this folder.

#pragma once

#include "app/render/copies.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

namespace billet::render {

/// What lies in all of these is taken away.
using Removed = std::vector<HalfSpace>;

/// @param towards  the viewer, from the part
[[nodiscard]] std::vector<Removed> removed_by(const std::vector<Cut>& cuts, const Vec3& towards);

[[nodiscard]] std::vector<Removed> before(const std::vector<Removed>& removed, const Copy& copy);

/// The part of faces or lines in a half-space.
[[nodiscard]] vtkSmartPointer<vtkPolyData> part_in(vtkPolyData& data, const HalfSpace& space);

/// Faces or lines without what is taken away.
[[nodiscard]] vtkSmartPointer<vtkPolyData> without(vtkSmartPointer<vtkPolyData> data,
                                                   const std::vector<Removed>& removed);

/// Faces in the cut planes, with the fields of the cells that they cut.
struct CutFaces {
  vtkSmartPointer<vtkPolyData> faces;
  vtkSmartPointer<vtkPolyData> lines; ///< where elements meet in them
};

/// @param solid  cells with a volume
[[nodiscard]] CutFaces cut_faces(vtkUnstructuredGrid& solid, const std::vector<Removed>& removed);

} // namespace billet::render
