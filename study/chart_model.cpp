#include "study/chart_model.h"

#include "geometry/base/error.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace billet::study {

namespace {

/// Slopes at the points of a monotone cubic.
std::vector<double> slopes_of(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  std::vector<double> secants(n - 1), slopes(n);
  for (std::size_t i = 0; i + 1 < n; ++i)
    secants[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secants[i - 1] * secants[i] <= 0.0)
      continue;
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double w1 = 2.0 * after + before, w2 = after + 2.0 * before;
    slopes[i] = (w1 + w2) / (w1 / secants[i - 1] + w2 / secants[i]); // (Fritsch and Butland)
  }
  // At the ends a parabola through three points, no steeper than keeps it monotone.
  const auto at_end = [](double h0, double h1, double d0, double d1) {
    const double slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (slope * d0 <= 0.0)
      return 0.0;
    return d0 * d1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d0) ? 3.0 * d0 : slope;
  };
  if (n == 2) {
    slopes[0] = slopes[1] = secants[0];
  } else {
    slopes[0] = at_end(x[1] - x[0], x[2] - x[1], secants[0], secants[1]);
    slopes[n - 1] =
        at_end(x[n - 1] - x[n - 2], x[n - 2] - x[n - 3], secants[n - 2], secants[n - 3]);
  }
  return slopes;
}

/// Stations at which a curve is known, and its values there.
struct KnownCurve {
  std::vector<double> x, y;
};

KnownCurve known(const std::vector<double>& stations, const std::vector<double>& values) {
  KnownCurve curve;
  for (std::size_t s = 0; s < stations.size(); ++s)
    if (std::isfinite(values[s])) {
      curve.x.push_back(stations[s]);
      curve.y.push_back(values[s]);
    }
  return curve;
}

/// @return not a number where the curve does not reach
double along(const std::vector<double>& stations, const std::vector<double>& values, double x) {
  const KnownCurve curve = known(stations, values);
  constexpr double rounding = 1e-9;
  const double slack = rounding * (stations.back() - stations.front());
  if (curve.x.empty() || x < curve.x.front() - slack || x > curve.x.back() + slack)
    return std::nan("");
  if (curve.x.size() == 1)
    return curve.y.front();
  return monotone_cubic(curve.x, curve.y, std::clamp(x, curve.x.front(), curve.x.back()));
}

/// A figure of the chart at the places, for every point of the parameters' grid.
std::vector<std::vector<double>>
at_places(const Chart& chart,
          std::span<const Measured> data,
          const std::function<const std::vector<std::vector<double>>&(std::size_t)>& of_quantity) {
  std::vector<std::vector<double>> grid(of_quantity(0).size());
  for (std::size_t point = 0; point < grid.size(); ++point)
    for (const Measured& each : data)
      grid[point].push_back(along(chart.stations, of_quantity(each.quantity)[point], each.x));
  return grid;
}

/// Second derivatives of the natural cubic spline at its points.
Eigen::VectorXd natural_spline(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::Map<const Eigen::VectorXd> at(x.data(), n), values(y.data(), n);
  const Eigen::VectorXd h = at.tail(n - 1) - at.head(n - 1);
  const Eigen::VectorXd secants = (values.tail(n - 1) - values.head(n - 1)).cwiseQuotient(h);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    matrix.row(i).segment(i - 1, 3) << h[i - 1] / 6.0, (h[i - 1] + h[i]) / 3.0, h[i] / 6.0;
    right[i] = secants[i] - secants[i - 1];
  }
  return matrix.partialPivLu().solve(right);
}

/// What the curve between the points may be off: half as much again as a natural spline and the
/// monotone cubic are apart in the middle of the spaces next to each point.
std::vector<double> errors_of_spacing(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::VectorXd second = natural_spline(x, y);
  constexpr double safety = 1.5;
  std::vector<double> errors(x.size());
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double h = x[i + 1] - x[i];
    const auto at = static_cast<Eigen::Index>(i);
    const double spline = 0.5 * (y[i] + y[i + 1]) - h * h / 16.0 * (second[at] + second[at + 1]);
    const double apart = safety * std::abs(spline - monotone_cubic(x, y, x[i] + 0.5 * h));
    errors[i] = std::max(errors[i], apart);
    errors[i + 1] = apart;
  }
  return errors;
}

bool reaches_all(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

} // namespace

double monotone_cubic(std::span<const double> x, std::span<const double> y, double at) {
  const std::vector<double> slopes = slopes_of(x, y);
  const auto after =
      static_cast<std::size_t>(std::upper_bound(x.begin() + 1, x.end() - 1, at) - x.begin());
  const std::size_t i = after - 1;
  const double h = x[i + 1] - x[i], t = (at - x[i]) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * y[i] + (t3 - 2.0 * t2 + t) * h * slopes[i] +
         (3.0 * t2 - 2.0 * t3) * y[i + 1] + (t3 - t2) * h * slopes[i + 1];
}

ChartModel::ChartModel(const Chart& chart, const ChartedLaw& law, std::span<const Measured> data) {
  for (const Measured& each : data) {
    quantities_.push_back(each.quantity);
    constexpr double rounding = 1e-9;
    const double slack = rounding * (chart.stations.back() - chart.stations.front());
    if (each.x < chart.stations.front() - slack || each.x > chart.stations.back() + slack)
      throw Error(Fault::case_file, "",
                  fmt::format("{} = {} was measured, the chart goes from {} to {}", chart.x, each.x,
                              chart.stations.front(), chart.stations.back()),
                  "make a chart with stations around it");
  }
  for (const Parameter& parameter : law.parameters)
    grids_.push_back(parameter.values);
  const auto quantity = [&](std::size_t q) -> const ChartedQuantity& { return law.quantities[q]; };
  values_ =
      at_places(chart, data, [&](std::size_t q) -> const Grid& { return quantity(q).values; });
  errors_ =
      at_places(chart, data, [&](std::size_t q) -> const Grid& { return quantity(q).model_error; });
  for (std::size_t u = 0; u < chart.uncertain.size(); ++u)
    changes_.push_back(at_places(
        chart, data, [&](std::size_t q) -> const Grid& { return quantity(q).change[u]; }));
  leave_out_unreached();
  constexpr std::size_t least = 2;
  const bool whole = std::all_of(values_.begin(), values_.end(), reaches_all);
  if (!whole || grids_.front().size() < least)
    throw Error(
        Fault::case_file, "",
        fmt::format("law '{}': too few runs of the chart reach all places that were measured",
                    law.name),
        "leave the farthest out, or chart parameters whose runs get there");
  static_cast<void>(fill_unknown(errors_)); // where one level failed
  for (std::size_t u = 0; u < changes_.size(); ++u)
    if (!fill_unknown(changes_[u]))
      partly_known_.push_back(u);
  add_errors_of_spacing();
}

void ChartModel::leave_out_unreached() {
  if (grids_.size() != 1)
    return;
  for (std::size_t point = values_.size(); point-- > 0;) {
    if (reaches_all(values_[point]))
      continue;
    const auto at = static_cast<std::ptrdiff_t>(point);
    left_out_.push_back(grids_[0][point]);
    grids_[0].erase(grids_[0].begin() + at);
    values_.erase(values_.begin() + at);
    errors_.erase(errors_.begin() + at);
    for (Grid& change : changes_)
      change.erase(change.begin() + at);
  }
}

void ChartModel::add_errors_of_spacing() {
  std::size_t stride = values_.size();
  for (const std::vector<double>& grid : grids_) {
    stride /= grid.size();
    if (grid.size() < 3)
      continue;
    for (std::size_t point = 0; point < values_.size(); ++point) {
      if (point / stride % grid.size() != 0)
        continue; // not the first of its line
      for (std::size_t place = 0; place < quantities_.size(); ++place) {
        std::vector<double> line;
        for (std::size_t i = 0; i < grid.size(); ++i)
          line.push_back(values_[point + i * stride][place]);
        const std::vector<double> of_spacing = errors_of_spacing(grid, line);
        for (std::size_t i = 0; i < grid.size(); ++i) {
          double& error = errors_[point + i * stride][place];
          error = std::hypot(error, of_spacing[i]);
        }
      }
    }
  }
}

Eigen::VectorXd ChartModel::between(const Grid& grid, std::span<const double> parameters) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(quantities_.size()));
  const std::size_t n_last = grids_.back().size();
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    std::vector<double> first; // along the first of two parameters
    for (std::size_t begin = 0; begin < grid.size(); begin += n_last) {
      std::vector<double> line;
      for (std::size_t p = begin; p < begin + n_last; ++p)
        line.push_back(grid[p][i]);
      first.push_back(monotone_cubic(grids_.back(), line, parameters.back()));
    }
    result[static_cast<Eigen::Index>(i)] =
        grids_.size() == 1 ? first.front()
                           : monotone_cubic(grids_.front(), first, parameters.front());
  }
  return result;
}

Eigen::VectorXd ChartModel::values(std::span<const double> parameters) const {
  return between(values_, parameters);
}

Eigen::MatrixXd ChartModel::error_factors(std::span<const double> parameters) const {
  const auto n = static_cast<Eigen::Index>(quantities_.size());
  const std::size_t n_quantities =
      quantities_.empty() ? 0 : 1 + *std::max_element(quantities_.begin(), quantities_.end());
  const auto n_changes = static_cast<Eigen::Index>(changes_.size());
  Eigen::MatrixXd factors =
      Eigen::MatrixXd::Zero(n, n_changes + static_cast<Eigen::Index>(n_quantities));
  for (Eigen::Index u = 0; u < n_changes; ++u)
    factors.col(u) = between(changes_[static_cast<std::size_t>(u)], parameters);
  constexpr double half_width_of_95 = 1.96; // in standard deviations
  const Eigen::VectorXd e = between(errors_, parameters) / half_width_of_95;
  for (Eigen::Index i = 0; i < n; ++i) // mesh and spacing err in one direction along a quantity
    factors(i, n_changes + static_cast<Eigen::Index>(quantities_[static_cast<std::size_t>(i)])) =
        e[i];
  return factors;
}

std::array<double, 2> ChartModel::span(std::size_t place) const {
  std::array<double, 2> ends{values_.front()[place], values_.front()[place]};
  for (const std::vector<double>& at : values_)
    ends = {std::min(ends[0], at[place]), std::max(ends[1], at[place])};
  return ends;
}

bool ChartModel::fill_unknown(Grid& grid) const {
  bool all_known = true;
  const Grid known = grid;
  const auto n = static_cast<std::ptrdiff_t>(grid.size());
  for (std::size_t place = 0; place < quantities_.size(); ++place)
    for (std::ptrdiff_t point = 0; point < n; ++point) {
      double& figure = grid[static_cast<std::size_t>(point)][place];
      if (std::isfinite(figure))
        continue;
      all_known = false;
      figure = 0.0;
      for (std::ptrdiff_t away = n - 1; away > 0; --away) // the nearest is the last
        for (const std::ptrdiff_t other : {point + away, point - away})
          if (other >= 0 && other < n &&
              std::isfinite(known[static_cast<std::size_t>(other)][place]))
            figure = known[static_cast<std::size_t>(other)][place];
    }
  return all_known;
}

} // namespace billet::study
