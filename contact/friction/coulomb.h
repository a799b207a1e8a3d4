// Coulomb friction, with a threshold pressure and a cap.

#pragma once

#include "contact/friction/friction_law.h"

#include <algorithm>
#include <limits>

namespace billet::contact {

/// tau_lim = min(mu (p - threshold)+, cap). (C.8): the paper's eqs 3 and 4.
///
/// Below the threshold the limit is zero (the paper's print would make it negative). The cap is a
/// stress, or the shear yield stress of the material beneath when `cap_at_shear_yield`.
struct Coulomb {
  double mu;                                            ///< friction coefficient [-]
  double threshold = 0.0;                               ///< sigma_A [MPa]
  double cap = std::numeric_limits<double>::infinity(); ///< [MPa]
  bool cap_at_shear_yield = false;                      ///< the cap is k

  static constexpr std::string_view name = "coulomb";

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double most = cap_at_shear_yield ? std::min(cap, at.shear_yield) : cap;
    const double sliding = mu * (at.pressure - threshold);
    if (sliding <= 0.0)
      return {0.0, 0.0};
    return sliding < most ? SlipLimit{sliding, mu} : SlipLimit{most, 0.0};
  }
};

} // namespace billet::contact
