// Where a tool is at a time: prescribed rigid motions.
//
// A tool lives in its own frame, in which its shape is given; `place` puts it where it starts and
// `pose(t)` maps it to space at a time: x = R X + d. Motions never know shapes.
//
// Units   mm, s, rad.

#pragma once

#include "geometry/base/time_function.h"
#include "geometry/base/vector.h"
#include "geometry/crank.h"

#include <array>
#include <limits>
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

/// What a press strikes with: a moving mass, and the speed it has when a blow begins.
struct Blow {
  double mass = 0.0;  ///< that has the energy of all that moves at that speed [N s^2/mm], > 0
  double speed = 0.0; ///< along the axis of the drive [mm/s], > 0

  [[nodiscard]] double energy() const { return 0.5 * mass * speed * speed; } ///< [N mm]
};

/// A degree of freedom that a load drives: along an axis, or about it.
struct Drive {
  Vec3 point = Vec3::Zero();  ///< on the axis; of no meaning for a travel
  Vec3 axis = Vec3::UnitZ();  ///< unit vector
  TimeFunction load;          ///< [N], or [N mm]
  std::optional<Blow> blow{}; ///< of a travel: inertia drives it as well; absent: it has none
};

/// Where the driven degrees of freedom of a tool are.
struct Driven {
  double travel = 0.0; ///< along the axis of the force [mm]
  double turn = 0.0;   ///< about the axis of the torque [rad]
};

/// Motion of a tool: prescribed (a translation over time, a rotation over time, or both), or driven
/// by a force in place of the translation and a torque in place of the rotation. The translation is
/// a velocity, a table or a crank.
///
/// The tool is placed first, then turned, then shifted; the rotation axis is given in space at time
/// 0 and travels with the translation. `offset` is the displacement by which `touch` brought the
/// tool to first contact before time 0.
struct Motion {
  Pose place;                                              ///< where the tool is at time 0
  std::optional<Vec3> velocity;                            ///< [mm/s]
  std::optional<std::array<TimeFunction, 3>> displacement; ///< [mm]; instead of velocity
  std::optional<Crank> crank;                              ///< instead of either
  std::optional<Rotation> rotation;
  std::optional<Drive> force;  ///< instead of a translation
  std::optional<Drive> torque; ///< instead of rotation
  Vec3 offset = Vec3::Zero();
  double rests_from = std::numeric_limits<double>::infinity(); ///< it stays where it is then [s]

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
