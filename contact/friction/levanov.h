// A share of the shear yield stress that grows with the pressure and saturates.

#pragma once

#include "contact/friction/friction_law.h"
#include "geometry/base/parameter.h"

#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = m k (1 - exp(-exponent p / sigma_y)), sigma_y = sqrt(3) k. (F.7a)
///
/// Under a low pressure it is Coulomb's law with mu = exponent m / sqrt(3), under a high one
/// Tresca's.
struct Levanov {
  double m;               ///< share [-], 0 to 1
  ShearYieldStress k;     ///< [MPa]
  double exponent = 1.25; ///< [-], > 0

  static constexpr std::string_view name = "levanov";
  static constexpr std::tuple parameters{
      Parameter{"m", &Levanov::m, quantity::number, allowed::fraction}.coefficient(),
      Parameter{"k", &Levanov::k, quantity::stress, allowed::positive}.optional(),
      Parameter{"exponent", &Levanov::exponent, quantity::number, allowed::positive}.optional(),
  };

  bool operator==(const Levanov&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double shear_yield = stress(k, at);
    const double share = m * at.factor;
    const double x = at.pressure > 0.0
                         ? exponent * at.pressure / (std::numbers::sqrt3 * shear_yield)
                         : 0.0; // infinite where there is no shear_yield
    const double left = shear_yield > 0.0 || x > 0.0 ? std::exp(-x) : 0.0;
    const double reached = -std::expm1(-x);
    // A stronger metal carries more, but of a smaller share.
    const double d_k = reached - (left > 0.0 ? x * left : 0.0);
    return {share * reached * shear_yield, share * exponent / std::numbers::sqrt3 * left,
            follows_material(k) ? share * d_k : 0.0, 0.0, m * reached * shear_yield};
  }
};

} // namespace billet::contact
