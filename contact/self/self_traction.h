// The traction at a point of the surface that touches another face of the part, with its exact
// derivative.
//
// The law is that of tools. What the tool's frame is there, axes of a place of the other face are
// here: of the place that the point touched when the increment began. Pressure follows from the gap
// along the normal of the closest place; the path slid is what the point has gone in those axes.
//
// Signs   gap < 0 inside; pressure > 0; tractions act on the point, the other face feels the
//         opposite.
// Theory  docs/theory/contact.md (C.50)-(C.53).

#pragma once

#include "contact/law/interface_law.h"
#include "contact/self/face_place.h"
#include "contact/self/self_state.h"

#include <optional>
#include <span>

namespace billet::contact {

/// What a traction is differentiated by: the point, then position and both tangents of the closest
/// place, then those of the place that it touched when the increment began.
constexpr int n_self_variables = 21;

/// Another face, at the place that is closest to a point.
struct SelfFoot {
  Index face = -1; ///< -1: none
  ClosestPlace place;
  double gap = 0.0; ///< along the normal of the place [mm]
  Vec3 normal = Vec3::Zero();
};

/// What the traction depends on in addition to the history.
struct SelfInput {
  Vec3 point; ///< [mm]
  SelfFoot foot;
  std::span<const Vec3> face;     ///< nodes of the foot's face [mm]
  std::span<const Vec3> old_face; ///< of the face touched before, if any [mm]
  mechanics::ElementKind kind;
  bool plane = false;       ///< the scene is a plane one
  double shear_yield = 0.0; ///< [MPa]
  double rounding = 0.0;    ///< gaps up to it count as touching [mm]
  double dt = 1.0;          ///< [s]
  double softening = 1.0;   ///< of the stiffness against slip [-]
  double carried = 0.0;     ///< pressure that needs no penetration [MPa]
};

struct SelfTraction {
  Traction law; ///< in space; its derivatives are not used
  SelfFoot foot;
  Index old_face = -1; ///< touched when the increment began
  Vec2 old_xi = Vec2::Zero();
  Eigen::Matrix<double, 3, n_self_variables> d_traction =
      Eigen::Matrix<double, 3, n_self_variables>::Zero();
  /// Of the place on the face.
  Eigen::Matrix<double, 2, n_self_variables> d_place =
      Eigen::Matrix<double, 2, n_self_variables>::Zero();

  [[nodiscard]] bool closed() const { return law.status != Status::open; }
};

/// (C.50)-(C.53)
[[nodiscard]] SelfTraction self_traction(const Friction& friction,
                                         const Penalty& penalty,
                                         const SelfPoint& old,
                                         const SelfInput& at,
                                         const SlipScheme& scheme);

} // namespace billet::contact
