#include "study/extrapolation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>

namespace billet::study {

namespace {

/// phi_0 + sum of alpha_j h^p_j, its coefficients by least squares.
struct Fit {
  std::vector<double> fitted; ///< at the sizes
  double limit = 0.0;
  double deviation = 0.0; ///< standard, of the values from the fit
};

/// @param free  parameters that the values have determined, the orders included
Fit fit_of(std::span<const double> sizes,
           std::span<const double> values,
           std::span<const double> orders,
           std::size_t free) {
  const auto n = static_cast<Eigen::Index>(sizes.size());
  const auto m = static_cast<Eigen::Index>(orders.size());
  Eigen::MatrixXd terms(n, m + 1);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    terms(i, 0) = 1.0;
    for (Eigen::Index j = 0; j < m; ++j)
      terms(i, j + 1) =
          std::pow(sizes[static_cast<std::size_t>(i)], orders[static_cast<std::size_t>(j)]);
    right[i] = values[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd coefficients = terms.colPivHouseholderQr().solve(right);
  const Eigen::VectorXd fitted = terms * coefficients;
  const double left = static_cast<double>(sizes.size()) - static_cast<double>(free);
  return {{fitted.data(), fitted.data() + n},
          coefficients[0],
          left > 0.0 ? std::sqrt((fitted - right).squaredNorm() / left) : 0.0};
}

/// The order with the least squares, and the fit.
std::pair<double, Fit> power_fit(std::span<const double> sizes, std::span<const double> values) {
  constexpr double lowest = 0.05, highest = 8.0;
  constexpr int scanned = 40, bits = 40;
  const auto off = [&](double p) {
    const Fit fit = fit_of(sizes, values, std::span(&p, 1), 0);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += std::pow(fit.fitted[i] - values[i], 2.0);
    return sum;
  };
  double best = lowest;
  const double step = (highest - lowest) / scanned;
  for (int i = 0; i <= scanned; ++i)
    if (const double p = lowest + step * i; off(p) < off(best))
      best = p;
  const auto [p, sum] = boost::math::tools::brent_find_minima(off, std::max(lowest, best - step),
                                                              std::min(highest, best + step), bits);
  return {p, fit_of(sizes, values, std::span(&p, 1), 3)};
}

bool is_monotone(std::span<const double> sizes, std::span<const double> values) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  bool up = true, down = true;
  for (std::size_t i = 1; i < order.size(); ++i) {
    up = up && values[order[i]] >= values[order[i - 1]];
    down = down && values[order[i]] <= values[order[i - 1]];
  }
  return up || down;
}

/// Of several fits the one that the values lie nearest to.
Fit nearest(std::span<const Fit> fits) {
  return *std::min_element(fits.begin(), fits.end(),
                           [](const Fit& a, const Fit& b) { return a.deviation < b.deviation; });
}

} // namespace

Extrapolation extrapolate(std::span<const double> sizes, std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double spread = *high - *low;
  const auto finest =
      static_cast<std::size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
  constexpr double rounding = 1e-12;
  Extrapolation result;
  result.limit = values[finest];
  result.uncertainty.assign(values.size(), 3.0 * spread);
  if (spread <= rounding * std::max(std::abs(*low), std::abs(*high))) {
    result.range = Extrapolation::Range::constant;
    return result;
  }
  if (!is_monotone(sizes, values))
    return result;
  constexpr double slowest = 0.5, fastest = 2.1; // as Eca and Hoekstra have them
  constexpr double first = 1.0, second = 2.0;
  auto [p, fit] = power_fit(sizes, values);
  result.order = p;
  result.range = Extrapolation::Range::asymptotic;
  if (p > fastest || p < slowest) {
    const double both[] = {first, second};
    std::vector<Fit> fits{fit_of(sizes, values, std::span(&first, 1), 2),
                          fit_of(sizes, values, std::span(&second, 1), 2)};
    if (p < slowest && sizes.size() > 3)
      fits.push_back(fit_of(sizes, values, both, 3));
    fit = nearest(fits);
    result.range = p > fastest ? Extrapolation::Range::too_fast : Extrapolation::Range::too_slow;
  }
  result.limit = fit.limit;
  const double apart = spread / static_cast<double>(values.size() - 1);
  const bool is_good = p >= slowest && fit.deviation < apart;
  const double safety = is_good ? 1.25 : 3.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = std::abs(values[i] - fit.fitted[i]);
    const double error = std::abs(fit.fitted[i] - fit.limit);
    result.uncertainty[i] = fit.deviation < apart
                                ? safety * error + fit.deviation + off
                                : safety * fit.deviation / apart * (error + fit.deviation + off);
    if (result.range == Extrapolation::Range::too_slow) // the limit may be anywhere
      result.uncertainty[i] = std::max(result.uncertainty[i], 3.0 * spread);
  }
  return result;
}

std::string in_words(Extrapolation::Range range) {
  switch (range) {
  case Extrapolation::Range::asymptotic:
    return "asymptotic";
  case Extrapolation::Range::too_fast:
    return "not in the asymptotic range (order above 2)";
  case Extrapolation::Range::too_slow:
    return "not in the asymptotic range (order below 1/2)";
  case Extrapolation::Range::no_monotony:
    return "not in the asymptotic range (values go up and down)";
  case Extrapolation::Range::constant:
    return "does not change";
  }
  return {};
}

} // namespace billet::study
