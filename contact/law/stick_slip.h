// Stick and slip in the tangent plane: the shear at the end of an increment.
//
// Elastic up to the slip limit, sliding beyond it, in components of a frame of the tangent plane.
// Three integrators of the slide: `radial` (backward Euler, one closed-form return), `midpoint`
// (the paper's: sub-increments of the generalised mid-point rule) and `exact` (the closed form of a
// straight path while the limit changes linearly). They differ only where the path turns.
//
// Theory  docs/theory/friction.md (F.13)-(F.19).

#pragma once

#include "contact/friction/friction.h"

namespace billet::contact {

enum class Status : signed char { open, stick, slip };

enum class Integrator { radial, midpoint, exact };

/// How the slide is integrated.
struct SlipScheme {
  Integrator integrator = Integrator::radial;
  int substeps = 0; ///< of `midpoint`; 0: as many as the turn of the shear asks for
};

/// One increment of one point, in the tangent plane.
struct SlipStep {
  Vec2 shear;       ///< of the committed state, turned into the plane [MPa]
  Vec2 path;        ///< relative displacement [mm]
  double stiffness; ///< against slip [MPa/mm], > 0
  double limit_old; ///< slip limit of the committed state [MPa]
  SlipState state;  ///< at the end of the increment
};

/// Shear at the end of the increment and its exact derivatives.
struct SlipResult {
  Status status = Status::stick;
  Vec2 shear;         ///< [MPa]
  Vec2 slip;          ///< irreversible part of the path [mm]
  double limit;       ///< slip limit at the end [MPa]; with a tensor: the shear slipping, else the
                      ///< mean over directions
  Mat2 d_shear;       ///< by the committed shear [-]
  Mat2 d_path;        ///< by the path [MPa/mm]
  Vec2 d_pressure;    ///< [-]
  Vec2 d_shear_yield; ///< [-]
};

/// (F.13)-(F.19)
///
/// @param Q  the friction tensor in the frame; identity: isotropic. Anisotropic friction is always
///           integrated by `radial`
[[nodiscard]] SlipResult stick_slip(const Friction& friction,
                                    const SlipScheme& scheme,
                                    const SlipStep& step,
                                    const Mat2& Q = Mat2::Identity());

} // namespace billet::contact
