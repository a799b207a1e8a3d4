// Isotropic hardening: yield stress as a function of accumulated plastic strain.
//
// A flow law is a small value type that answers one question: the yield stress at a plastic strain
// and its slope. The J2 return map (j2_hencky.h) asks every law that question in the same way.
//
// Units   stresses in MPa (consistent units), strains dimensionless.
// Theory  docs/theory/mechanics.md (M.10).

#pragma once

#include <concepts>
#include <string_view>

namespace billet::mechanics {

/// Yield stress and its derivative with respect to plastic strain.
struct FlowStress {
  double stress; ///< sigma_y [MPa], >= 0
  double slope;  ///< d sigma_y / d plastic strain [MPa]; may be infinite at zero strain
};

/// A value type that gives the yield stress; `flow_stress` is pure, its slope exact.
template <class Law>
concept FlowLaw = std::copyable<Law> && requires(const Law& law, double plastic_strain) {
  { law.flow_stress(plastic_strain) } -> std::same_as<FlowStress>;
  { Law::name } -> std::convertible_to<std::string_view>;
};

} // namespace billet::mechanics
