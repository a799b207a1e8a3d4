// The ram of a hammer or a screw press between two increments: a mass that the work of its tool
// brings to rest.
//
// The trapezoidal rule gives the mass over an increment exactly the energy that the trapezoidal sum
// of the tool's forces takes from it, so no energy is lost or made, however long the increment.
//
// Units   N, mm, s; masses N s^2/mm. Signs: positive along the axis of the drive.
// Theory: docs/theory/process.md (P.10).

#pragma once

namespace billet::contact {

/// State of a ram at the end of an increment.
struct Ram {
  double mass = 0.0;  ///< [N s^2/mm]
  double speed = 0.0; ///< [mm/s]
  double force = 0.0; ///< that accelerates it: its load less what the workpiece resists [N]

  /// Mass times acceleration at the end of an increment that moves it by `way`. (P.10)
  [[nodiscard]] double inertia(double way, double dt) const {
    return 4.0 * mass * (way / dt - speed) / dt - force;
  }
  /// d inertia / d way [N/mm].
  [[nodiscard]] double stiffness(double dt) const { return 4.0 * mass / (dt * dt); }
  /// Speed at the end of that increment. (P.10)
  [[nodiscard]] double speed_after(double way, double dt) const { return 2.0 * way / dt - speed; }
  /// [N mm]
  [[nodiscard]] double energy() const { return 0.5 * mass * speed * speed; }

  template <class Archive> void fields(Archive& archive) { archive(mass, speed, force); }
};

} // namespace billet::contact
