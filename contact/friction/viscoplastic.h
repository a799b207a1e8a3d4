// A film that yields by a power of the sliding speed.

#pragma once

#include "contact/friction/friction_law.h"
#include "geometry/base/parameter.h"

#include <cmath>
#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = beta (|v_t| / v0)^mv. (F.9): the paper's eq 10.
///
/// For mv < 1 the slope is infinite at rest. Below v0 / 1000 the power is replaced by the odd cubic
/// that meets it with the same value and slope, so the law is smooth through a reversal. (F.10)
struct Viscoplastic {
  double beta; ///< characteristic friction stress [MPa]
  double v0;   ///< characteristic speed [mm/s]
  double mv;   ///< exponent [-], 0 < mv <= 1

  static constexpr std::string_view name = "viscoplastic";
  static constexpr bool creeps = true;
  static constexpr std::tuple parameters{
      Parameter{"beta", &Viscoplastic::beta, quantity::stress, allowed::not_negative},
      Parameter{"v0", &Viscoplastic::v0, quantity::speed, allowed::positive},
      Parameter{"mv", &Viscoplastic::mv, quantity::number, allowed::positive_fraction},
  };
  static constexpr double start = 1e-3; ///< below this share of v0 the cubic holds [-]

  bool operator==(const Viscoplastic&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double w = at.speed / v0;
    const auto [value, slope] = w < start ? cubic(w) : power(w);
    return {at.factor * beta * value, 0.0, 0.0, at.factor * beta * slope / v0, beta * value};
  }

private:
  struct ValueAndSlope {
    double value;
    double slope;
  };

  [[nodiscard]] ValueAndSlope power(double w) const noexcept {
    const double value = std::pow(w, mv);
    return {value, mv * value / w};
  }

  [[nodiscard]] ValueAndSlope cubic(double w) const noexcept {
    const double x = w / start;
    const double a = 0.5 * (3.0 - mv);
    const double b = 0.5 * (mv - 1.0);
    const double size = std::pow(start, mv);
    return {size * (a + b * x * x) * x, size * (a + 3.0 * b * x * x) / start};
  }
};

} // namespace billet::contact
