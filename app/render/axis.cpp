#include "app/render/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

namespace {

constexpr double rounding = 1e-9;

/// Between two values, ends included: 1, 2 and 5 times powers of ten, or every step-th power.
std::vector<double> logarithmic_ticks(double low, double high, double step) {
  std::vector<double> ticks;
  const auto first = static_cast<int>(std::floor(std::log10(low) + rounding));
  const int decades = std::max(static_cast<int>(std::round(step)), 1);
  for (int decade = first;; decade += decades)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, decade);
      if (tick > high * (1.0 + rounding))
        return ticks;
      if (tick >= low * (1.0 - rounding) && (step < 1.0 || factor == 1.0))
        ticks.push_back(tick);
    }
}

} // namespace

double Axis::share(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::vector<double> Axis::ticks() const {
  if (logarithmic)
    return logarithmic_ticks(low, high, step);
  std::vector<double> ticks;
  const double first = std::round(low / step);
  const auto n = static_cast<int>(std::round(high / step) - first);
  for (int i = 0; i <= n; ++i)
    ticks.push_back((first + i) * step);
  return ticks;
}

std::string Axis::label(double tick) const {
  if (logarithmic)
    return fmt::format("{:.6g}", tick);
  constexpr double small = 1e-4, large = 1e6;
  if (step < small || std::max(std::abs(low), std::abs(high)) >= large)
    return fmt::format("{:.6g}", tick);
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", tick, digits);
}

Axis axis_through_zero(double least, double most, int most_steps) {
  double low = std::min(least, 0.0), high = std::max(most, 0.0);
  constexpr double nothing = 0.005; // of the whole: rounding, springback
  if (-low < nothing * high)
    low = 0.0;
  if (high < nothing * -low)
    high = 0.0;
  return axis_of(low, high, most_steps);
}

Axis axis_of(double low, double high, int most_steps) {
  if (low == high) { // one value: in the middle
    const double around = low != 0.0 ? 0.5 * std::abs(low) : 1.0;
    low -= low != 0.0 ? around : 0.0;
    high += around;
  }
  const double power = std::pow(10.0, std::floor(std::log10((high - low) / most_steps)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    const double step = factor * power;
    const double first = std::floor(low / step + rounding),
                 last = std::ceil(high / step - rounding);
    if (last - first <= most_steps || factor == 10.0)
      return {first * step, last * step, step};
  }
  return {};
}

Axis logarithmic_axis(double least, double most, int most_steps) {
  constexpr double third = 1.0 / 3.0, few = 2.0;
  const double low = std::floor(std::log10(least) + rounding);
  const double high = std::ceil(std::log10(most) - rounding);
  if (high - low > few) {
    const double step = std::ceil((high - low) / most_steps);
    return {std::pow(10.0, low), std::pow(10.0, high), step, true};
  }
  // The ticks next to the values; one value: those on either side of it.
  const bool one = least == most;
  double below = std::pow(10.0, low - 1.0), above = std::pow(10.0, high + 1.0);
  for (const double tick : logarithmic_ticks(below, above, third)) {
    if (one ? tick < least * (1.0 - rounding) : tick <= least * (1.0 + rounding))
      below = tick;
    if (one ? tick > most * (1.0 + rounding) : tick >= most * (1.0 - rounding)) {
      above = tick;
      break;
    }
  }
  return {below, above, third, true};
}

} // namespace billet::render
