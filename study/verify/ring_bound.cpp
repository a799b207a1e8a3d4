#include "study/verify/ring_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::study {

namespace {

/// Derivative of the power by c, over 2 pi sigma A [mm]; it rises with c, for the power is convex.
double power_slope(const RingShape& ring, double m, double c) {
  const double q = c / std::numbers::sqrt3;
  const double flow =
      std::numbers::sqrt3 / 6.0 * ring.height *
      (std::asinh(q / (ring.bore * ring.bore)) - std::asinh(q / (ring.outside * ring.outside)));
  const double neutral = std::clamp(std::sqrt(std::max(0.0, c)), ring.bore, ring.outside);
  return flow + m / std::numbers::sqrt3 * (2.0 * neutral - ring.bore - ring.outside);
}

/// The ring when its height has gone down by a length at a field.
RingShape moved(const RingShape& from, const RingShape& rates, double c, double down) {
  const auto radius = [&](double start, double at) {
    return start + 0.5 * down / rates.height * (at - c / at);
  };
  return {radius(from.bore, rates.bore), radius(from.outside, rates.outside), from.height - down};
}

} // namespace

double neutral_square(const RingShape& ring, double m) {
  double low = 0.0, high = ring.outside * ring.outside;
  for (int i = 0; i < 100; ++i) {
    const double c = 0.5 * (low + high);
    (power_slope(ring, m, c) > 0.0 ? high : low) = c;
  }
  return 0.5 * (low + high);
}

double bore_decrease_of_bound(const RingShape& ring, double m, double reduction) {
  constexpr int steps = 2000; // of the mid-point rule
  const double down = ring.height * reduction / steps;
  RingShape now = ring;
  for (int i = 0; i < steps; ++i) {
    const RingShape middle = moved(now, now, neutral_square(now, m), 0.5 * down);
    now = moved(now, middle, neutral_square(middle, m), down);
  }
  return 100.0 * (1.0 - now.bore / ring.bore);
}

} // namespace billet::study
