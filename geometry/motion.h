// Where a tool is at a time: prescribed rigid motions.
//
// A tool lives in its own frame, in which its shape is given; `place` puts it where it starts and
// `pose(t)` maps it to space at a time: x = R X + d. Motions never know shapes.
//
// Units   mm, s, rad.

#pragma once

#include "geometry/base/time_function.h"
#include "geometry/base/vector.h"

#include <array>
#include <optional>

namespace billet::geometry {

/// A rigid placement x = rotation * X + translation.
struct Pose {
  Mat3 rotation = Mat3::Identity(); ///< [-]
  Vec3 translation = Vec3::Zero();  ///< [mm]

  [[nodiscard]] Vec3 to_space(const Vec3& X) const { return rotation * X + translation; }
  [[nodiscard]] Vec3 to_tool(const Vec3& x) const {
    return rotation.transpose() * (x - translation);
  }
};

/// Rotation by `angle` [rad] about the line through `point` along the unit vector `axis`.
[[nodiscard]] Pose rotation_about(const Vec3& point, const Vec3& axis, double angle);

/// Rotation about an axis with a speed over time.
struct Rotation {
  Vec3 point = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ(); ///< unit vector
  TimeFunction speed;        ///< [rad/s]
};

/// A degree of freedom that a load drives: along an axis, or about it.
struct Drive {
  Vec3 point = Vec3::Zero(); ///< on the axis; of no meaning for a travel
  Vec3 axis = Vec3::UnitZ(); ///< unit vector
  TimeFunction load;         ///< [N], or [N mm]
};

/// Where the driven degrees of freedom of a tool are.
struct Driven {
  double travel = 0.0; ///< along the axis of the force [mm]
  double turn = 0.0;   ///< about the axis of the torque [rad]
};

/// Motion of a tool: prescribed (a translation over time, a rotation over time, or both), or driven
/// by a force in place of the translation and a torque in place of the rotation.
///
/// The tool is placed first, then turned, then shifted; the rotation axis is given in space at time
/// 0 and travels with the translation. `offset` is the displacement by which `touch` brought the
/// tool to first contact before time 0.
struct Motion {
  Pose place;                                              ///< where the tool is at time 0
  std::optional<Vec3> velocity;                            ///< [mm/s]
  std::optional<std::array<TimeFunction, 3>> displacement; ///< [mm]; instead of velocity
  std::optional<Rotation> rotation;
  std::optional<Drive> force;  ///< instead of velocity and displacement
  std::optional<Drive> torque; ///< instead of rotation
  Vec3 offset = Vec3::Zero();

  [[nodiscard]] Pose pose(double time, const Driven& driven = {}) const;
  /// Where the tool is when it has been shifted and turned by that much.
  [[nodiscard]] Pose pose_at(const Vec3& shift, double turned_by) const;
  /// Displacement of the tool's reference point (without offset) [mm].
  [[nodiscard]] Vec3 translation(double time, const Driven& driven = {}) const;
  /// Angle turned since time 0 [rad].
  [[nodiscard]] double angle(double time, const Driven& driven = {}) const;
  /// Unit vector along the axis of turns, zero if there are none.
  [[nodiscard]] Vec3 axis() const;
  /// A point on that axis at time 0, without offset [mm].
  [[nodiscard]] Vec3 axis_point() const;
};

} // namespace billet::geometry
