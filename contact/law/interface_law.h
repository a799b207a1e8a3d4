// The traction at one contact point: unilateral pressure and stick-slip friction by penalty.
//
// Everything happens in the frame of the tool, where the tool stands still: a rigid motion of tool
// and workpiece together changes nothing (incremental objectivity, the paper's Fig. 13). Pressure
// follows from the penetration itself, not from an accumulated increment; shear is an elastic
// stick stress, turned with the normal, and kept within the law's limit (stick_slip.h). A point
// that touches within the increment rubs from then on: over the share of the way that its motion
// predicts, with a limit of no more than the pressure. A share that followed the gap of the trial
// would let the shear grow faster than the pressure and destroy uniqueness. A point that has slid a
// long way turns its shear round within a small part of that way: next to a neutral point a sharper
// turn would be a jump.
//
// Signs   gap < 0 inside the tool; pressure > 0; tractions act on the workpiece.
// Theory  docs/theory/contact.md (C.1)-(C.6), (C.17)-(C.18), (C.20), (C.42); friction.md (F.3a).

#pragma once

#include "contact/law/stick_slip.h"
#include "geometry/base/vector.h"
#include "geometry/rigid_surface.h"

#include <optional>

namespace billet::contact {

/// History of one point against one tool, in the tool's frame.
struct PointHistory {
  Vec3 position = Vec3::Zero(); ///< of the workpiece point [mm]
  Vec3 normal = Vec3::Zero();   ///< of the tool at the foot; zero: it was open [-]
  Vec3 shear = Vec3::Zero();    ///< tangential traction [MPa]
  double pressure = 0.0;        ///< [MPa]
  double sliding = 0.0;         ///< sliding distance so far [mm]
  double stiffness = 0.0;       ///< against slip from here on (C.17); 0: the penalty [MPa/mm]
  double multiplier = 0.0;      ///< pressure that needs no penetration (C.20) [MPa]
  double offset = 0.0;          ///< added to the gap: what a new mesh is off by (C.41) [mm]
  /// Added to the gap: of a linear face on a curved tool (C.43) [mm].
  double sagitta_offset = 0.0;
  /// Added to the gap: what keeps pressure from oscillating along a face (C.45) [mm].
  double gap_correction = 0.0;
  double decayed = 0.0; ///< by what all three have decayed at the last commit [mm]
  double limit = 0.0;   ///< slip limit, at least the shear [MPa]
  bool slips = false;   ///< has slipped in the last increment

  [[nodiscard]] bool closed() const { return !normal.isZero(0.0); }
  [[nodiscard]] Status status() const {
    return !closed() ? Status::open : slips ? Status::slip : Status::stick;
  }
  /// What is added to the gap of the point that the surface gives [mm].
  [[nodiscard]] double added() const { return offset + sagitta_offset + gap_correction; }

  template <class Archive> void fields(Archive& archive) {
    archive(position, normal, shear, pressure, sliding, stiffness, multiplier, offset,
            sagitta_offset, gap_correction, decayed, limit, slips);
  }
};

/// Penalties of a point: pressure per penetration, shear per slip [MPa/mm].
struct Penalty {
  double normal;
  double tangent;
};

/// Traction at the end of an increment with its exact derivative.
struct Traction {
  Status status = Status::open;
  double pressure = 0.0;            ///< [MPa]
  Vec3 shear = Vec3::Zero();        ///< [MPa]
  Vec3 traction = Vec3::Zero();     ///< p n + shear, on the workpiece [MPa]
  Mat3 dtraction_dx = Mat3::Zero(); ///< [MPa/mm], not symmetric when slipping
  Vec3 dtraction_dp = Vec3::Zero(); ///< by the pressure [-]
  Vec3 dtraction_dk = Vec3::Zero(); ///< by the shear yield stress of the parent element [-]
  Vec3 slip = Vec3::Zero();         ///< irreversible sliding in the increment [mm]
  double limit = 0.0;               ///< largest shear at this pressure, or at the one before [MPa]
  double lag = 0.0; ///< by what the shear is off the law at this pressure (F.3a) [MPa]
  /// The old shear in the new tangent plane, as far to the slip as it was when the increment began
  /// [MPa].
  Vec3 turned = Vec3::Zero();

  template <class Archive> void fields(Archive& archive) {
    archive(status, pressure, shear, traction, dtraction_dx, dtraction_dp, dtraction_dk, slip,
            limit, lag, turned);
  }
};

/// A pressure that follows from the gaps of all points of a face. (C.45)
struct SharedPressure {
  double pressure;  ///< [MPa]
  double stiffness; ///< by which it falls with the point's own gap [MPa/mm]
};

/// What the traction depends on in addition to the history.
struct InterfaceInput {
  Vec3 position;                   ///< tool frame [mm]
  geometry::Projection projection; ///< of that position
  double shear_yield = 0.0;        ///< k of the parent element [MPa]
  double rounding = 0.0;           ///< gaps up to it count as touching [mm]
  double dt = 1.0;                 ///< of the increment [s]
  double softening = 1.0;  ///< of the stiffness against slip, below 1 on the way to a solution [-]
  bool kept = false;       ///< a point that was closed stays so, if need be under tension (C.15)
  double multiplier = 0.0; ///< pressure that needs no penetration (C.20) [MPa]
  double noise = 0.0;      ///< of a gap: what coordinates of their size cannot tell [mm]
  double touching = 0.0; ///< share of the increment in which a point that was open rubs (C.42) [-]
  std::optional<SharedPressure> shared = std::nullopt; ///< in place of the point's own
  Vec3 turn = Vec3::Zero();     ///< of the tool against the face in the increment, tool frame [rad]
  bool friction_lagged = false; ///< a point that was closed has the slip limit of the pressure
                                ///< that it had then (F.3a)
};

/// Energy that a shear stores in a stiffness against slip [N/mm]; 0 without stiffness.
[[nodiscard]] double shear_energy(const Vec3& shear, double stiffness);

/// What an increment leaves behind in the shear.
struct ShearBalance {
  double stiffness = 0.0;     ///< against slip from here on (C.17) [MPa/mm]
  double friction_work = 0.0; ///< what the shear did and is not stored (C.18) [N/mm]
  /// Of it, what the trapezoidal rule does not see, nor does that of tools and supports. (C.18a)
  double unseen = 0.0;
};

/// Stiffness of the next increment and friction work of this one. (C.17), (C.18)
///
/// @param sliding  distance so far, with this increment [mm]
/// @param depth    of the parent element [mm]
[[nodiscard]] ShearBalance balance(const Penalty& penalty,
                                   const PointHistory& old,
                                   const Traction& now,
                                   double sliding,
                                   double depth);

/// (C.1)-(C.6), (C.20)
[[nodiscard]] Traction traction(const Friction& friction,
                                const Penalty& penalty,
                                const PointHistory& old,
                                const InterfaceInput& at,
                                const SlipScheme& scheme = {});

/// Turns a vector tangent to `from` into the plane normal to `to` by the smallest rotation. (C.4)
[[nodiscard]] Vec3 turn(const Vec3& v, const Vec3& from, const Vec3& to);

} // namespace billet::contact
