// Real over apparent area of contact, as asperities are flattened by pressure.
//
// The paper takes the ratio from asperity flattening (its reference 14, Wanheim and Bay; its Fig.
// 7) without printing a formula. `wanheim_bay` is Bay's fit to the slip-line fields: linear up to
// the limit of proportionality, exponential above it. N. Bay, "Friction stress and normal stress
// in bulk metal-forming processes", J. Mech. Working Technology 14 (1987) 203-223.

#pragma once

#include <cmath>
#include <numbers>

namespace billet::contact {

/// How the ratio grows with pressure.
enum class Flattening {
  wanheim_bay,  ///< asperities that share the metal beneath them (F.5)
  bowden_tabor, ///< hardness: alpha = min(1, p / (3 sigma_0)), the paper's eq 2 (F.6)
};

/// alpha = A_ec / A_c and its derivative by p / sigma_0.
struct ContactRatio {
  double alpha; ///< [-], 0 to 1
  double slope; ///< [-]
};

/// The ratio at a pressure p = `pressure_ratio` sigma_0. (F.5)
///
/// @param f  friction factor of the asperities' tops [-], 0 to 1
[[nodiscard]] inline ContactRatio wanheim_bay(double pressure_ratio, double f) {
  const double root = std::sqrt(1.0 - f);
  // Limit of proportionality; alpha' = (1 - sqrt(1 - f)) / f without the cancellation at small f.
  const double alpha_limit = 1.0 / (1.0 + root);
  const double limit = (1.0 + 0.5 * std::numbers::pi + std::acos(f) + std::sqrt(1.0 - f * f)) /
                       (std::numbers::sqrt3 * (1.0 + root));
  const double x = pressure_ratio / limit;
  if (x <= 1.0)
    return {alpha_limit * x, alpha_limit / limit};
  if (alpha_limit >= 1.0)
    return {1.0, 0.0};
  const double rate = alpha_limit / (1.0 - alpha_limit);
  const double left = (1.0 - alpha_limit) * std::exp(-rate * (x - 1.0));
  return {1.0 - left, rate * left / limit};
}

/// The ratio at a pressure p = `pressure_ratio` sigma_0. (F.6)
[[nodiscard]] inline ContactRatio bowden_tabor(double pressure_ratio) {
  constexpr double hardness = 3.0; // H / sigma_0, the paper below its eq 1
  const double alpha = pressure_ratio / hardness;
  return alpha < 1.0 ? ContactRatio{alpha, 1.0 / hardness} : ContactRatio{1.0, 0.0};
}

/// The ratio, whichever way the asperities flatten.
[[nodiscard]] inline ContactRatio contact_ratio(Flattening flattening, double p_ratio, double f) {
  return flattening == Flattening::wanheim_bay ? wanheim_bay(p_ratio, f) : bowden_tabor(p_ratio);
}

} // namespace billet::contact
