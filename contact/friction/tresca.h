// A constant share of the shear yield stress.

#pragma once

#include "contact/friction/friction_law.h"

#include <optional>

namespace billet::contact {

/// tau_lim = m k. (F.4): the paper's eq 7.
struct Tresca {
  double m;                ///< share [-], 0 to 1
  std::optional<double> k; ///< shear yield stress [MPa]; absent: of the material beneath

  static constexpr std::string_view name = "tresca";

  [[nodiscard]] bool follows_material() const noexcept { return !k; }

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    if (m == 0.0)
      return {0.0, 0.0};
    const double strength = k.value_or(at.shear_yield);
    const double share = m * at.factor;
    return {share * strength, 0.0, k ? 0.0 : share, 0.0, m * strength};
  }
};

} // namespace billet::contact
