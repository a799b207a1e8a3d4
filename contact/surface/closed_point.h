// What a contact point that touches a tool has done in the last committed increment.
//
// Wear and the process window are sums over these: they look at what contact has done and change
// nothing.
//
// Frame   of the tool. Signs: pressure > 0 in compression, the normal leaves the tool.

#pragma once

#include "geometry/base/vector.h"

#include <cstddef>

namespace billet::contact {

struct ClosedPoint {
  std::size_t point = 0;      ///< of the contact surface
  Vec3 from = Vec3::Zero();   ///< where it was when the increment began [mm]
  Vec3 to = Vec3::Zero();     ///< where it is [mm]
  Vec3 foot = Vec3::Zero();   ///< closest point of the tool [mm]
  Vec3 normal = Vec3::Zero(); ///< of the tool there [-]
  /// Share of the increment in which it touched, as far as its beginning could tell: 1 for a point
  /// that was closed, 0 for one whose touch came unpredicted. (C.42)
  double touching = 1.0;
  double pressure_old = 0.0; ///< when the increment began; 0: it was open [MPa]
  double pressure = 0.0;     ///< [MPa]
  double slip = 0.0;         ///< irreversible sliding in the increment [mm]
  double sliding = 0.0;      ///< sliding distance so far [mm]
  double area = 0.0;         ///< that the point stands for [mm^2]

  /// Over the increment, by the trapezoidal rule [MPa].
  [[nodiscard]] double mean_pressure() const { return 0.5 * (pressure_old + pressure); }

  template <class Archive> void fields(Archive& archive) {
    archive(point, from, to, foot, normal, touching, pressure_old, pressure, slip, sliding, area);
  }
};

} // namespace billet::contact
