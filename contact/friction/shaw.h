// Shear of the real area of contact.

#pragma once

#include "contact/friction/asperity.h"

namespace billet::contact {

/// tau_lim = alpha(p) k. (F.7): the paper's eq 6.
struct Shaw {
  std::optional<double> k; ///< shear yield stress [MPa]; absent: of the material beneath
  double f;                ///< friction factor with which asperities were flattened [-], 0 to 1
  Flattening flattening = Flattening::wanheim_bay;

  static constexpr std::string_view name = "shaw";

  [[nodiscard]] bool follows_material() const noexcept { return !k; }

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    return Asperity{1.0, k, f, flattening}.slip_limit(at);
  }
};

} // namespace billet::contact
