#include "geometry/motion.h"

#include <Eigen/Geometry>

namespace billet::geometry {

Pose rotation_about(const Vec3& point, const Vec3& axis, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return {R, point - R * point};
}

Vec3 Motion::translation(double time) const {
  if (velocity)
    return *velocity * time;
  if (displacement)
    return {(*displacement)[0](time), (*displacement)[1](time), (*displacement)[2](time)};
  return Vec3::Zero();
}

double Motion::angle(double time) const { return rotation ? rotation->speed.integral(time) : 0.0; }

Pose Motion::pose(double time) const {
  const Pose turned =
      rotation ? rotation_about(rotation->point, rotation->axis, angle(time)) : Pose{};
  return {turned.rotation * place.rotation,
          turned.to_space(place.translation) + offset + translation(time)};
}

} // namespace billet::geometry
