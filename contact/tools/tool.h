// A rigid tool: a name, a shape, a motion, and friction and wear on it.

#pragma once

#include "contact/friction/friction.h"
#include "contact/law/wear_law.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <limits>
#include <optional>
#include <string>

namespace billet::contact {

/// Shapes never move and motions never know shapes.
struct Tool {
  std::string name;
  geometry::SurfacePtr surface; ///< in the tool's frame
  geometry::Motion motion;
  Friction friction;
  std::optional<PairWear> wear = std::nullopt; ///< absent: none is looked at
  Vec3 reference = Vec3::Zero(); ///< point in the tool's frame about which torques are taken [mm]
  /// How far the shape that facets stand for may lie off them, an estimate; 0: a formula [mm].
  double chord_error = 0.0;
  double active_from = -std::numeric_limits<double>::infinity(); ///< [s]
  double active_to = std::numeric_limits<double>::infinity();    ///< [s]

  std::string said_at; ///< where the case names it, for messages; empty: nowhere
  /// On which side of its surface it lies and how it is turned round, for messages; empty: nothing
  /// to say.
  std::string facing;

  [[nodiscard]] bool active(double time) const { return time >= active_from && time <= active_to; }
};

} // namespace billet::contact
