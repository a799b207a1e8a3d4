// Friction at the flattened tops of asperities.

#pragma once

#include "contact/friction/contact_ratio.h"
#include "contact/friction/friction_law.h"
#include "geometry/base/parameter.h"

#include <numbers>
#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = m_local alpha(p) k. (F.7): the paper's eq 8.
struct Asperity {
  double m_local;     ///< share of k that the tops carry [-], 0 to 1
  ShearYieldStress k; ///< [MPa]
  double f;           ///< friction factor with which they were flattened [-], 0 to 1
  Flattening flattening = Flattening::wanheim_bay;

  static constexpr std::string_view name = "asperity";
  static constexpr std::tuple parameters{
      Parameter{"m_local", &Asperity::m_local, quantity::number, allowed::fraction}.coefficient(),
      Parameter{"k", &Asperity::k, quantity::stress, allowed::positive},
      Parameter{"real_contact", &Asperity::flattening}.optional(),
      only_with(&Asperity::flattening,
                Flattening::wanheim_bay,
                Parameter{"f", &Asperity::f, quantity::number, allowed::fraction}),
  };

  bool operator==(const Asperity&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double shear_yield = stress(k, at);
    if (!(shear_yield > 0.0))
      return {0.0, 0.0};
    const double sigma_0 = std::numbers::sqrt3 * shear_yield;
    const double p_ratio = at.pressure / sigma_0;
    const ContactRatio ratio = contact_ratio(flattening, p_ratio, f);
    const double share = m_local * at.factor;
    // A stronger metal carries more and is flattened less.
    const double d_k = follows_material(k) ? share * (ratio.alpha - p_ratio * ratio.slope) : 0.0;
    return {share * ratio.alpha * shear_yield, share * ratio.slope / std::numbers::sqrt3, d_k, 0.0,
            m_local * ratio.alpha * shear_yield};
  }
};

} // namespace billet::contact
