// Coulomb friction, with a threshold pressure, a term of second order and a cap.

#pragma once

#include "contact/friction/friction_law.h"
#include "geometry/base/limits.h"
#include "geometry/base/parameter.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = min(mu q + mu2 q^2, cap), q = (p - threshold)+. (F.2): the paper's eqs 3, 4 and 5.
///
/// Below the threshold the limit is zero (the paper's print would make it negative).
struct Coulomb {
  double mu;                                          ///< friction coefficient [-]
  double threshold = 0.0;                             ///< sigma_A [MPa]
  std::optional<ShearYieldStress> cap = std::nullopt; ///< absent: none
  double mu2 = 0.0;                                   ///< of second order [1/MPa]

  static constexpr std::string_view name = "coulomb";
  static constexpr std::tuple parameters{
      Parameter{"mu", &Coulomb::mu, quantity::number, allowed::not_negative}.coefficient(),
      Parameter{"threshold", &Coulomb::threshold, quantity::stress, allowed::not_negative}
          .optional(),
      Parameter{"mu2", &Coulomb::mu2, quantity::inverse_stress, allowed::not_negative}.or_absent(),
      Parameter{"cap", &Coulomb::cap, quantity::stress, allowed::positive}.or_absent(),
  };

  bool operator==(const Coulomb&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double most = cap ? stress(*cap, at) : infinity;
    const double q = std::max(0.0, at.pressure - threshold);
    const double sliding = at.factor * (mu + mu2 * q) * q;
    if (sliding <= 0.0)
      return {0.0, 0.0, 0.0, 0.0, (mu + mu2 * q) * q};
    if (sliding >= most)
      return {most, 0.0, cap && follows_material(*cap) ? 1.0 : 0.0};
    return {sliding, at.factor * (mu + 2.0 * mu2 * q), 0.0, 0.0, (mu + mu2 * q) * q};
  }
};

} // namespace billet::contact
