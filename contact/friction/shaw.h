// Shear of the real area of contact.

#pragma once

#include "contact/friction/asperity.h"
#include "geometry/base/parameter.h"

#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = alpha(p) k. (F.7): the paper's eq 6.
struct Shaw {
  ShearYieldStress k; ///< [MPa]
  double f;           ///< friction factor with which asperities were flattened [-], 0 to 1
  Flattening flattening = Flattening::wanheim_bay;

  static constexpr std::string_view name = "shaw";
  static constexpr std::tuple parameters{
      Parameter{"k", &Shaw::k, quantity::stress, allowed::positive},
      Parameter{"real_contact", &Shaw::flattening}.optional(),
      only_with(&Shaw::flattening,
                Flattening::wanheim_bay,
                Parameter{"f", &Shaw::f, quantity::number, allowed::fraction}),
  };

  bool operator==(const Shaw&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    return Asperity{1.0, k, f, flattening}.slip_limit(at);
  }
};

} // namespace billet::contact
