#include "app/render/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  const double first = std::round(low / step), last = std::round(high / step);
  for (double i = first; i <= last; i += 1.0)
    ticks.push_back(i * step);
  return ticks;
}

std::string Axis::label(double tick) const {
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
    constexpr double rounding = 1e-9;
    const double first = std::floor(low / step + rounding),
                 last = std::ceil(high / step - rounding);
    if (last - first <= most_steps || factor == 10.0)
      return {first * step, last * step, step};
  }
  return {};
}

} // namespace billet::render
