#include "geometry/motion.h"

#include <Eigen/Geometry>

namespace billet::geometry {

Pose rotation_about(const Vec3& point, const Vec3& axis, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return {R, point - R * point};
}

Vec3 Motion::translation(double time, const Driven& driven) const {
  if (velocity)
    return *velocity * time;
  if (displacement)
    return {(*displacement)[0](time), (*displacement)[1](time), (*displacement)[2](time)};
  return force ? Vec3(driven.travel * force->axis) : Vec3(Vec3::Zero());
}

double Motion::angle(double time, const Driven& driven) const {
  if (rotation)
    return rotation->speed.integral(time);
  return torque ? driven.turn : 0.0;
}

Pose Motion::pose(double time, const Driven& driven) const {
  Pose turned;
  if (rotation)
    turned = rotation_about(rotation->point, rotation->axis, angle(time));
  else if (torque)
    turned = rotation_about(torque->point, torque->axis, driven.turn);
  return {turned.rotation * place.rotation,
          turned.to_space(place.translation) + offset + translation(time, driven)};
}

} // namespace billet::geometry
