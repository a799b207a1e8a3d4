// Friction of a tool: a law, and what modifies any law.
//
// Evolution with the sliding distance (a lubricant that wears off) and tables act on the law's
// coefficient; a tensor turns and scales the shear (anisotropic surfaces). Theory:
// docs/theory/friction.md.

#pragma once

#include "contact/friction/any_friction_law.h"
#include "contact/friction/coefficient_table.h"
#include "geometry/base/vector.h"

#include <concepts>
#include <optional>
#include <utility>

namespace billet::contact {

using Mat2 = Eigen::Matrix2d;

/// Anisotropy: sliding along the unit vector d meets the shear tau_lim Q d. (F.12)
struct FrictionTensor {
  Mat2 Q;         ///< [-], symmetric part positive definite
  Vec3 direction; ///< of the first axis, in the tool's frame; projected on the tangent plane
};

struct Friction;

/// A law on its own. Whether a friction is a law must not be asked: the answer would depend on the
/// constructor that asks (clang 14 goes round in circles).
template <class Law>
concept LoneFrictionLaw = !std::same_as<Law, Friction> && FrictionLaw<Law>;

/// A law and its modifiers. Every law is a friction.
struct Friction {
  AnyFrictionLaw law = Frictionless{};
  CoefficientTable evolution{}; ///< factor on the coefficient over the sliding distance
  CoefficientTable table{};     ///< in place of the coefficient, which is 1 then
  std::optional<FrictionTensor> tensor = std::nullopt;

  Friction() = default;
  template <LoneFrictionLaw Law>
  Friction(Law one) : law(std::move(one)) {} // NOLINT(google-explicit-constructor)
  Friction(AnyFrictionLaw one) : law(one) {} // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool follows_material() const { return contact::follows_material(law); }
  /// What the shear yield stress of the parent element is taken from; none: nothing asks for it.
  [[nodiscard]] std::optional<FollowedStress> followed_stress() const {
    return contact::followed_stress(law);
  }
  /// Whether the limit depends on how far and how fast the point slides in the increment.
  [[nodiscard]] bool depends_on_slip() const;
};

/// State of a point that its slip limit depends on.
struct SlipState {
  double pressure;      ///< [MPa]
  double shear_yield;   ///< k of the parent element [MPa]
  double sliding = 0.0; ///< distance before the increment [mm]
  double dt = 1.0;      ///< of the increment, as far as the point touches [s]
  bool limited = false; ///< no more shear than pressure, as where a point touches (F.3)
};

/// Slip limit with its derivatives by what changes within an increment.
struct LimitAtSlip {
  double shear;         ///< [MPa]
  double d_pressure;    ///< [-]
  double d_shear_yield; ///< [-]
  double d_slip;        ///< [MPa/mm]
};

/// The limit after sliding by `slip` in the increment, below the cone. (F.1), (F.3)
[[nodiscard]] LimitAtSlip limit_at(const Friction& friction, const SlipState& at, double slip);

} // namespace billet::contact
