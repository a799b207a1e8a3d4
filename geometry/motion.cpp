#include "geometry/motion.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace billet::geometry {

Pose rotation_about(const Vec3& point, const Vec3& axis, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return {R, point - R * point};
}

Vec3 Motion::translation(double at, const Driven& driven) const {
  const double time = std::min(at, rests_from);
  if (velocity)
    return *velocity * time;
  if (displacement)
    return {(*displacement)[0](time), (*displacement)[1](time), (*displacement)[2](time)};
  if (crank)
    return crank->travel(time) * crank->axis;
  return force ? Vec3(driven.travel * force->axis) : Vec3(Vec3::Zero());
}

double Motion::angle(double time, const Driven& driven) const {
  if (rotation)
    return rotation->speed.integral(std::min(time, rests_from));
  return torque ? driven.turn : 0.0;
}

Vec3 Motion::axis() const {
  if (rotation)
    return rotation->axis;
  return torque ? torque->axis : Vec3(Vec3::Zero());
}

Vec3 Motion::axis_point() const {
  if (rotation)
    return rotation->point;
  return torque ? torque->point : Vec3(Vec3::Zero());
}

Pose Motion::pose(double time, const Driven& driven) const {
  return pose_at(translation(time, driven), angle(time, driven));
}

Pose Motion::pose_at(const Vec3& shift, double turned_by) const {
  Pose turned;
  if (rotation || torque)
    turned = rotation_about(axis_point(), axis(), turned_by);
  return {turned.rotation * place.rotation, turned.to_space(place.translation) + offset + shift};
}

} // namespace billet::geometry
