// Friction at the tool-workpiece interface.
//
// A friction law answers one question: how much shear can the interface carry before it slides,
// or, where a film creeps, at a speed of sliding? The stick-slip return map (interface_law.h) asks
// every law that question in the same way, so a law is a small value type and never sees tangents,
// history or the mesh.
//
// Signs   p >= 0 in compression. Units MPa, mm/s.
// Theory  docs/theory/friction.md; tags such as (F.2) are equations of that page, which names the
//         paper's.

#pragma once

#include <concepts>
#include <string_view>
#include <variant>

namespace billet::contact {

/// What the shear yield stress k of the parent element is taken from.
enum class FollowedStress {
  yield,     ///< its yield stress over sqrt(3)
  von_mises, ///< its von Mises stress over sqrt(3): the paper's generalisation of eq 7
};

/// A shear yield stress: of the parent element, or a value [MPa].
using ShearYieldStress = std::variant<FollowedStress, double>;

/// What a friction law may know about one contact point.
struct InterfacePoint {
  double pressure;     ///< p [MPa], >= 0
  double shear_yield;  ///< k, shear yield stress of the parent element [MPa]
  double speed = 0.0;  ///< of sliding, |v_t| [mm/s], >= 0
  double factor = 1.0; ///< on the law's coefficient [-]: its evolution, or a table in its place
};

/// The value of a shear yield stress at a point [MPa].
[[nodiscard]] inline double stress(const ShearYieldStress& shear_yield, const InterfacePoint& at) {
  const double* const given = std::get_if<double>(&shear_yield);
  return given != nullptr ? *given : at.shear_yield;
}

[[nodiscard]] inline bool follows_material(const ShearYieldStress& shear_yield) {
  return std::holds_alternative<FollowedStress>(shear_yield);
}

/// Largest shear the interface carries, and its exact partial derivatives. (F.1)
struct SlipLimit {
  double shear;               ///< tau_lim [MPa], >= 0; may be infinite
  double d_pressure;          ///< by p [-]
  double d_shear_yield = 0.0; ///< by k [-]
  double d_speed = 0.0;       ///< by the speed of sliding [MPa s/mm]
  double d_factor = 0.0;      ///< by the factor on the coefficient [MPa]
};

/// A value type that bounds the interface shear; `slip_limit` is pure, its slopes exact. `name` and
/// `parameters` (geometry/base/parameter.h) are those of case files.
template <class Law>
concept FrictionLaw = std::copyable<Law> && requires(const Law& law, const InterfacePoint& at) {
  { law.slip_limit(at) } -> std::same_as<SlipLimit>;
  { Law::name } -> std::convertible_to<std::string_view>;
  Law::parameters;
};

} // namespace billet::contact
