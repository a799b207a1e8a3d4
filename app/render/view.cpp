#include "app/render/view.h"

#include "geometry/base/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace billet::render {

namespace {

/// Towards a viewer at angles about an axis.
Vec3 direction(int axis_up, double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180.0, e = elevation * std::numbers::pi / 180.0;
  Vec3 towards = Vec3::Zero();
  towards[axis_up] = std::sin(e);
  towards[(axis_up + 1) % 3] = std::cos(e) * std::cos(a);
  towards[(axis_up + 2) % 3] = std::cos(e) * std::sin(a);
  return towards;
}

Vec3 iso(int axis_up) {
  constexpr double low = 0.8, side = 1.3;
  switch (axis_up) {
  case 0:
    return {low, 1.0, side};
  case 1:
    return {1.0, low, side};
  default:
    return {1.0, -side, low};
  }
}

Vec3 towards_viewer(const View& view, int axis_up, bool flat) {
  switch (view.from) {
  case View::From::axis:
    return view.axis;
  case View::From::angles:
    return direction(axis_up, view.azimuth, view.elevation);
  case View::From::iso:
    return iso(axis_up);
  case View::From::usual:
    break;
  }
  return flat ? Vec3::UnitZ() : iso(axis_up);
}

} // namespace

Sight sight_of(const View& view, bool flat, bool revolved) {
  Sight sight;
  sight.axis_up = view.up.value_or(flat || revolved ? 1 : 2);
  sight.towards = towards_viewer(view, sight.axis_up, flat).normalized();
  constexpr double edge_on = 0.05;
  if (flat && std::abs(sight.towards.z()) < edge_on)
    throw Error(Fault::usage, "--view", "a scene of the plane is seen from z only",
                "--revolve makes a body of an axisymmetric one");
  // Straight from above the next axis points upwards.
  constexpr double parallel = 1.0 - 1e-9;
  int up = sight.axis_up;
  if (std::abs(sight.towards[up]) > parallel)
    up = up == 1 ? 2 : 1;
  const Vec3 upwards = up != sight.axis_up && up == 2 ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::Unit(up));
  sight.right = upwards.cross(sight.towards).normalized();
  sight.up = sight.towards.cross(sight.right);
  return sight;
}

void Extent::add(vtkPolyData& data) {
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    Vec3 x;
    data.GetPoint(i, x.data());
    add(x);
  }
}

void Extent::grow(double length) {
  const Vec3 margin(length, length, 0.0);
  box_ = Box{box_.low - margin, box_.high + margin};
}

Aim aim_at(const Extent& extent, const Sight& sight, const View& view, double aspect) {
  constexpr double margin = 1.06;
  const Box& box = extent.box();
  Vec3 middle = 0.5 * (box.low + box.high);
  Vec3 half = 0.5 * (box.high - box.low);
  if (view.focus) {
    const Vec3 focus(sight.right.dot(*view.focus), sight.up.dot(*view.focus),
                     sight.towards.dot(*view.focus));
    half = (box.high - focus).cwiseMax(focus - box.low);
    middle = focus;
  }
  Aim aim;
  aim.focus = middle.x() * sight.right + middle.y() * sight.up + middle.z() * sight.towards;
  const double size = box.size();
  const double least = 1e-6 * size;
  aim.half_height = margin * std::max({half.y(), half.x() / aspect, least}) / view.zoom;
  aim.depth = half.z() + size;
  return aim;
}

void place_camera(vtkCamera& camera, const Aim& aim, const Sight& sight) {
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(aim.focus.data());
  const double distance = 2.0 * aim.depth;
  const Vec3 eye = aim.focus + distance * sight.towards;
  camera.SetPosition(eye.data());
  camera.SetViewUp(sight.up.data());
  camera.SetParallelScale(aim.half_height);
  camera.SetClippingRange(distance - aim.depth, distance + aim.depth);
}

} // namespace billet::render
