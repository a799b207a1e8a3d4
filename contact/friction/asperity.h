// Friction at the flattened tops of asperities.

#pragma once

#include "contact/friction/contact_ratio.h"
#include "contact/friction/friction_law.h"

#include <numbers>
#include <optional>

namespace billet::contact {

/// tau_lim = m_local alpha(p) k. (F.7): the paper's eq 8.
struct Asperity {
  double m_local;          ///< share of k that the tops carry [-], 0 to 1
  std::optional<double> k; ///< shear yield stress [MPa]; absent: of the material beneath
  double f;                ///< friction factor with which they were flattened [-], 0 to 1
  Flattening flattening = Flattening::wanheim_bay;

  static constexpr std::string_view name = "asperity";

  [[nodiscard]] bool follows_material() const noexcept { return !k; }

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double strength = k.value_or(at.shear_yield);
    if (!(strength > 0.0))
      return {0.0, 0.0};
    const double sigma_0 = std::numbers::sqrt3 * strength;
    const double p_ratio = at.pressure / sigma_0;
    const ContactRatio ratio = contact_ratio(flattening, p_ratio, f);
    const double share = m_local * at.factor;
    // A stronger metal carries more and is flattened less.
    const double d_k = k ? 0.0 : share * (ratio.alpha - p_ratio * ratio.slope);
    return {share * ratio.alpha * strength, share * ratio.slope / std::numbers::sqrt3, d_k, 0.0,
            m_local * ratio.alpha * strength};
  }
};

} // namespace billet::contact
