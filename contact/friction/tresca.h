// A constant share of the shear yield stress.

#pragma once

#include "contact/friction/friction_law.h"
#include "geometry/base/parameter.h"

#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = m k. (F.4): the paper's eq 7.
struct Tresca {
  double m;           ///< share [-], 0 to 1
  ShearYieldStress k; ///< [MPa]

  static constexpr std::string_view name = "tresca";
  static constexpr std::tuple parameters{
      Parameter{"m", &Tresca::m, quantity::number, allowed::fraction}.coefficient(),
      Parameter{"k", &Tresca::k, quantity::stress, allowed::positive}.optional(),
  };

  bool operator==(const Tresca&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    if (m == 0.0)
      return {0.0, 0.0};
    const double shear_yield = stress(k, at);
    const double share = m * at.factor;
    return {share * shear_yield, 0.0, follows_material(k) ? share : 0.0, 0.0, m * shear_yield};
  }
};

} // namespace billet::contact
