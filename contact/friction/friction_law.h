// Friction at the tool-workpiece interface.
//
// A friction law answers one question: how much shear can the interface carry before it slides?
// The stick-slip return map (interface_law.h) asks every law that question in the same way, so a
// law is a small value type and never sees tangents, history or the mesh.
//
// Signs   p >= 0 in compression. Units MPa.
// Theory  docs/theory/contact.md; tags such as (C.8) are equations of that page, which names the
//         paper's.

#pragma once

#include <concepts>
#include <string_view>

namespace billet::contact {

/// What a friction law may know about one contact point.
struct InterfacePoint {
  double pressure;    ///< p [MPa], >= 0
  double shear_yield; ///< k of the material beneath at the last committed state [MPa]
};

/// Largest shear the interface carries, and how it grows with pressure. (C.7)
struct SlipLimit {
  double shear;      ///< tau_lim [MPa], >= 0; may be infinite
  double d_pressure; ///< d tau_lim / d p [-]
};

/// A value type that bounds the interface shear; `slip_limit` is pure, its slope exact.
template <class Law>
concept FrictionLaw = std::copyable<Law> && requires(const Law& law, const InterfacePoint& at) {
  { law.slip_limit(at) } -> std::same_as<SlipLimit>;
  { Law::name } -> std::convertible_to<std::string_view>;
};

} // namespace billet::contact
