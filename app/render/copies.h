// The part as a whole: mirror images and turned copies of what was computed. VTK in a header: only
// for sources of this folder.
//
// Copies carry the values of what they are copies of: a component is that of the computed part.

#pragma once

#include "app/render/options.h"
#include "geometry/base/vector.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

namespace billet::render {

/// x -> turn x + shift; `turn` is orthogonal.
struct Copy {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

/// Where normal . x > at.
struct HalfSpace {
  Vec3 normal = Vec3::UnitX();
  double at = 0.0;

  [[nodiscard]] double distance(const Vec3& x) const { return normal.dot(x) - at; }
  /// The half-space in the coordinates of what a copy was made of.
  [[nodiscard]] HalfSpace before(const Copy& copy) const {
    return {copy.turn.transpose() * normal, at - normal.dot(copy.shift)};
  }
};

/// The planes in which a part is mirrored.
/// @param solid  a body in space, not a section of the plane
/// @throws Error  (Fault::usage) for planes that are not known, or cut the part
[[nodiscard]] std::vector<AxisPlane> mirror_planes(vtkUnstructuredGrid& part,
                                                   const SceneOptions& options);

/// The part itself, first, its mirror images and those turned about an axis.
[[nodiscard]] std::vector<Copy>
copies_of(const std::vector<AxisPlane>& planes, int n_turned, int axis);

/// The sides of mirror planes where the part is.
[[nodiscard]] std::vector<HalfSpace> sides_of(const std::vector<AxisPlane>& planes,
                                              vtkDataSet& part);

/// All of them in one; active vectors and normals go along.
[[nodiscard]] vtkSmartPointer<vtkPolyData> copied(vtkPolyData& data, const Copy& copy);
[[nodiscard]] vtkSmartPointer<vtkPolyData>
joined(const std::vector<vtkSmartPointer<vtkPolyData>>& parts);

} // namespace billet::render
