// Isotropic hardening: yield stress as a function of accumulated plastic strain.
//
// A flow law is a small value type that answers one question: the yield stress at a plastic strain
// and its slope. The J2 return map (j2_hencky.h) asks every law that question in the same way. A
// rate law is asked for the flow stress at a strain, a strain rate and a temperature.
//
// Units   stresses in MPa (consistent units), strains dimensionless, rates 1/s, temperatures degC.
// Theory  docs/theory/mechanics.md (M.10), rate laws (M.25)-(M.28).

#pragma once

#include <concepts>
#include <string_view>

namespace billet::mechanics {

/// Yield stress and its derivative with respect to plastic strain.
struct FlowStress {
  double stress; ///< sigma_y [MPa], >= 0
  double slope;  ///< d sigma_y / d plastic strain [MPa]; may be infinite at zero strain
};

/// A value type that gives the yield stress; `flow_stress` is pure, its slope exact. `name` and
/// `parameters` (geometry/base/parameter.h) are those of case files.
template <class Law>
concept FlowLaw = std::copyable<Law> && requires(const Law& law, double plastic_strain) {
  { law.flow_stress(plastic_strain) } -> std::same_as<FlowStress>;
  { Law::name } -> std::convertible_to<std::string_view>;
  Law::parameters;
};

/// How fast and how hot the metal flows.
struct FlowPoint {
  double plastic_strain; ///< accumulated [-], >= 0
  double rate;           ///< of the plastic strain [1/s], >= 0
  double temperature;    ///< [degC]
};

/// Flow stress and its derivatives.
struct RateFlowStress {
  double stress;     ///< sigma [MPa], >= 0
  double slope;      ///< d sigma / d plastic strain [MPa]; may be infinite at zero strain
  double rate_slope; ///< d sigma / d rate [MPa s]; may be infinite at rate zero
};

/// A value type that gives the flow stress at a rate; `flow_stress` is pure, its slopes exact, and
/// the stress does not fall with the rate. At rate zero it is the stress below which nothing flows.
template <class Law>
concept RateFlowLaw = std::copyable<Law> && requires(const Law& law, const FlowPoint& at) {
  { law.flow_stress(at) } -> std::same_as<RateFlowStress>;
  { Law::name } -> std::convertible_to<std::string_view>;
  Law::parameters;
};

} // namespace billet::mechanics
