// From where a scene is looked at, and the scale at which all of it is in the picture. VTK in a
// header: only for sources of this folder.

#pragma once

#include "app/render/copies.h"
#include "app/render/options.h"
#include "geometry/base/box.h"

#include <vtkCamera.h>
#include <vtkPolyData.h>

namespace billet::render {

/// Directions of the picture, orthonormal.
struct Sight {
  Vec3 right = Vec3::UnitX();
  Vec3 up = Vec3::UnitY();
  Vec3 towards = Vec3::UnitZ(); ///< the viewer
  int axis_up = 1;              ///< the axis about which azimuths are counted
};

/// @param flat     a scene of the plane, not revolved
/// @param revolved a body whose axis is y
/// @throws Error  (Fault::usage) for a view that shows a scene of the plane from its edge
[[nodiscard]] Sight sight_of(const View& view, bool flat, bool revolved);

/// How far something reaches along the directions of the picture. [mm]
class Extent {
public:
  explicit Extent(const Sight& sight) : sight_(sight) {}
  void add(const Vec3& x) {
    box_.add({sight_.right.dot(x), sight_.up.dot(x), sight_.towards.dot(x)});
  }
  void add(vtkPolyData& data);
  /// By a length on all four sides of the picture.
  void grow(double length);
  [[nodiscard]] const Box& box() const { return box_; }

private:
  Sight sight_;
  Box box_;
};

/// Where the camera stands and how much it shows.
struct Aim {
  Vec3 focus = Vec3::Zero();
  double half_height = 1.0; ///< of the picture [mm]
  double depth = 1.0;       ///< of what is seen, before and behind the focus [mm]
};

/// The largest picture that holds the extent, with a margin.
/// @param aspect  width of the picture over its height
[[nodiscard]] Aim aim_at(const Extent& extent, const Sight& sight, const View& view, double aspect);

void place_camera(vtkCamera& camera, const Aim& aim, const Sight& sight);

} // namespace billet::render
