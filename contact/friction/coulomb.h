// Coulomb friction, with a threshold pressure, a term of second order and a cap.

#pragma once

#include "contact/friction/friction_law.h"

#include <algorithm>
#include <limits>

namespace billet::contact {

/// tau_lim = min(mu q + mu2 q^2, cap), q = (p - threshold)+. (F.2): the paper's eqs 3, 4 and 5.
///
/// Below the threshold the limit is zero (the paper's print would make it negative). The cap is a
/// stress, or the shear yield stress of the material beneath when `cap_at_shear_yield`.
struct Coulomb {
  double mu;                                            ///< friction coefficient [-]
  double threshold = 0.0;                               ///< sigma_A [MPa]
  double cap = std::numeric_limits<double>::infinity(); ///< [MPa]
  bool cap_at_shear_yield = false;                      ///< the cap is k
  double mu2 = 0.0;                                     ///< of second order [1/MPa]

  static constexpr std::string_view name = "coulomb";

  [[nodiscard]] bool follows_material() const noexcept { return cap_at_shear_yield; }

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const bool at_yield = cap_at_shear_yield && at.shear_yield < cap;
    const double most = at_yield ? at.shear_yield : cap;
    const double q = std::max(0.0, at.pressure - threshold);
    const double sliding = at.factor * (mu + mu2 * q) * q;
    if (sliding <= 0.0)
      return {0.0, 0.0, 0.0, 0.0, (mu + mu2 * q) * q};
    if (sliding >= most)
      return {most, 0.0, at_yield ? 1.0 : 0.0};
    return {sliding, at.factor * (mu + 2.0 * mu2 * q), 0.0, 0.0, (mu + mu2 * q) * q};
  }
};

} // namespace billet::contact
