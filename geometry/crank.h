// The slide of a crank press: how far it has come when the crank has turned.
//
// The crankshaft lies behind the slide; a rod joins its pin to the slide, which runs along `axis`
// through the shaft. At top dead centre (crank angle 0) the slide is at the back of its stroke, at
// bottom dead centre (half a turn) it is a stroke of twice the radius further on.
//
// Units   mm, s, rad. Theory: docs/theory/geometry.md (G.36).

#pragma once

#include "geometry/base/time_function.h"
#include "geometry/base/vector.h"

#include <vector>

namespace billet::geometry {

struct Crank {
  Vec3 axis = Vec3::UnitZ(); ///< unit vector, the way of the slide to bottom dead centre
  double radius = 0.0;       ///< of the crank, half the stroke [mm], > 0
  double rod = 0.0;          ///< length of the connecting rod [mm], > radius
  double start = 0.0;        ///< crank angle at time 0, 0 at top dead centre [rad]
  TimeFunction speed;        ///< of the crank [rad/s], >= 0

  /// Crank angle [rad].
  [[nodiscard]] double angle(double time) const { return start + speed.integral(time); }
  /// Way of the slide along the axis since time 0 [mm].
  [[nodiscard]] double travel(double time) const;
  /// Speed of the slide along the axis [mm/s].
  [[nodiscard]] double slide_speed(double time) const;
  /// Times after 0 and up to `end` at which the slide is at bottom dead centre, the first thousand.
  [[nodiscard]] std::vector<double> bottom_dead_centres(double end) const;

private:
  [[nodiscard]] double way_from_top(double angle) const;
};

} // namespace billet::geometry
