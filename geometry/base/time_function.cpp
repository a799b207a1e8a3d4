#include "geometry/base/time_function.h"

#include <cassert>
#include <utility>

namespace billet {

TimeFunction::TimeFunction(std::vector<std::pair<double, double>> points)
    : points_(std::move(points)) {
  assert(!points_.empty());
}

double TimeFunction::operator()(double time) const {
  if (time <= points_.front().first)
    return points_.front().second;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const auto& [t0, v0] = points_[i - 1];
    const auto& [t1, v1] = points_[i];
    if (time < t1)
      return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
  }
  return points_.back().second;
}

double TimeFunction::integral(double time) const {
  // The function is linear between the breakpoints, so the trapezoidal rule on them is exact.
  double sum = 0.0;
  double from = 0.0;
  for (const auto& [t, v] : points_) {
    if (t <= from || t >= time)
      continue;
    sum += 0.5 * ((*this)(from) + v) * (t - from);
    from = t;
  }
  return sum + 0.5 * ((*this)(from) + (*this)(time)) * (time - from);
}

} // namespace billet
