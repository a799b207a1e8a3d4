// A constant share of the shear yield stress.

#pragma once

#include "contact/friction/friction_law.h"

#include <optional>

namespace billet::contact {

/// tau_lim = m k. (C.9): the paper's eq 7.
struct Tresca {
  double m;                ///< share [-], 0 to 1
  std::optional<double> k; ///< shear yield stress [MPa]; absent: of the material beneath

  static constexpr std::string_view name = "tresca";

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    return {m == 0.0 ? 0.0 : m * k.value_or(at.shear_yield), 0.0};
  }
};

} // namespace billet::contact
