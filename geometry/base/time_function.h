// A quantity given over time: piecewise linear between points, constant outside.

#pragma once

#include <utility>
#include <vector>

namespace billet {

/// v(t) through the points (t, v), sorted by t; one point is a constant.
class TimeFunction {
public:
  TimeFunction(double constant = 0.0) : points_{{0.0, constant}} {} // NOLINT: a number is one
  explicit TimeFunction(std::vector<std::pair<double, double>> points);

  [[nodiscard]] double operator()(double time) const;
  /// Integral from 0 to `time`.
  [[nodiscard]] double integral(double time) const;
  [[nodiscard]] const std::vector<std::pair<double, double>>& points() const { return points_; }

  template <class Archive> void fields(Archive& archive) { archive(points_); }

private:
  std::vector<std::pair<double, double>> points_;
};

} // namespace billet
