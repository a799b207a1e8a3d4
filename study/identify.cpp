#include "study/identify.h"

#include "geometry/base/error.h"

#include <Eigen/QR>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "study/chart_model.h"

namespace billet::study {

namespace {

constexpr double inside = 0.95;

/// What is minimized.
struct Misfit {
  double deviance = 0.0;
  double chi_squared = 0.0;
};

/// Measurements compared with a law.
class Likelihood {
public:
  /// @param variance  of every measurement where none is known; 0: they are
  Likelihood(const ChartModel& model, std::span<const Measured> data, double variance)
      : model_(model), measured_(static_cast<Eigen::Index>(data.size())),
        variances_(static_cast<Eigen::Index>(data.size())) {
    for (std::size_t i = 0; i < data.size(); ++i) {
      measured_[static_cast<Eigen::Index>(i)] = data[i].value;
      variances_[static_cast<Eigen::Index>(i)] =
          variance > 0.0 ? variance : data[i].standard * data[i].standard;
    }
  }

  [[nodiscard]] Misfit operator()(std::span<const double> parameters) const {
    // chi^2 = min_z |D^-1/2 (left - F z)|^2 + |z|^2: least squares by an orthogonal factorization,
    // in which small uncertainties of the measured values do not cancel.
    const Eigen::VectorXd weights = variances_.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd factors = model_.error_factors(parameters);
    const Eigen::Index rows = factors.rows(), n = factors.cols();
    Eigen::MatrixXd columns(rows + n, n);
    columns << weights.asDiagonal() * factors, Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd left(rows + n);
    left << weights.cwiseProduct(measured_ - model_.values(parameters)), Eigen::VectorXd::Zero(n);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
    left.applyOnTheLeft(qr.householderQ().transpose());
    const double chi_squared = left.tail(rows).squaredNorm();
    const double log_determinant = variances_.array().log().sum() +
                                   2.0 * qr.matrixQR().diagonal().head(n).array().abs().log().sum();
    return {chi_squared + log_determinant, chi_squared};
  }

private:
  const ChartModel& model_;
  Eigen::VectorXd measured_, variances_;
};

/// Steps along each parameter, and the misfit at all their combinations.
struct Scan {
  std::vector<std::vector<double>> steps;
  std::vector<Misfit> misfits; ///< the last parameter changing fastest
  std::size_t best = 0;

  [[nodiscard]] std::size_t step_of(std::size_t point, std::size_t parameter) const {
    for (std::size_t p = steps.size(); p-- > parameter + 1;)
      point /= steps[p].size();
    return point % steps[parameter].size();
  }
  [[nodiscard]] double value(std::size_t point, std::size_t parameter) const {
    return steps[parameter][step_of(point, parameter)];
  }
};

Scan scan(const Likelihood& likelihood, const std::vector<std::array<double, 2>>& box) {
  const std::size_t count = box.size() == 1 ? 401 : 81;
  Scan found;
  std::size_t n = 1;
  for (const auto& [low, high] : box) {
    std::vector<double>& steps = found.steps.emplace_back();
    for (std::size_t i = 0; i < count; ++i)
      steps.push_back(i + 1 == count ? high
                                     : low + (high - low) * static_cast<double>(i) /
                                                 static_cast<double>(count - 1));
    n *= count;
  }
  std::vector<double> parameters(box.size());
  for (std::size_t point = 0; point < n; ++point) {
    for (std::size_t p = 0; p < box.size(); ++p)
      parameters[p] = found.value(point, p);
    found.misfits.push_back(likelihood(parameters));
    if (found.misfits.back().deviance < found.misfits[found.best].deviance)
      found.best = point;
  }
  if (!std::isfinite(found.misfits[found.best].deviance))
    throw Error(Fault::case_file, "",
                "the measured values are too far from the chart for their uncertainties: their "
                "distance in uncertainties is no number any more",
                "look at the values, at their uncertainties and at the units of both");
  return found;
}

/// The box of what is no worse than the best by so much, and a step more.
std::vector<std::array<double, 2>> box_around(const Scan& from, double above) {
  std::vector<std::array<double, 2>> box;
  for (std::size_t p = 0; p < from.steps.size(); ++p) {
    std::size_t low = from.steps[p].size(), high = 0;
    for (std::size_t point = 0; point < from.misfits.size(); ++point)
      if (from.misfits[point].deviance <= from.misfits[from.best].deviance + above) {
        low = std::min(low, from.step_of(point, p));
        high = std::max(high, from.step_of(point, p));
      }
    box.push_back({from.steps[p][low > 0 ? low - 1 : 0],
                   from.steps[p][std::min(high + 1, from.steps[p].size() - 1)]});
  }
  return box;
}

/// Scans the chart, then ever smaller boxes until the interval fills one.
Scan narrowed(const Likelihood& likelihood, const ChartModel& model, double above) {
  std::vector<std::array<double, 2>> box;
  for (std::size_t p = 0; p < model.n_parameters(); ++p)
    box.push_back({model.low(p), model.high(p)});
  Scan found = scan(likelihood, box);
  constexpr int most_times = 4;
  for (int i = 0; i < most_times; ++i) {
    std::vector<std::array<double, 2>> smaller = box_around(found, above);
    constexpr double filled = 0.7;
    bool fills = true;
    for (std::size_t p = 0; p < box.size(); ++p)
      fills = fills && smaller[p][1] - smaller[p][0] > filled * (box[p][1] - box[p][0]);
    if (fills)
      break;
    box = std::move(smaller);
    found = scan(likelihood, box);
  }
  return found;
}

/// Where the profile of a parameter's deviance crosses a height, linear between steps.
Found interval_of(const Scan& found, std::size_t p, double above, const ChartModel& model) {
  const std::vector<double>& steps = found.steps[p];
  std::vector<double> profile(steps.size(), std::numeric_limits<double>::infinity());
  for (std::size_t point = 0; point < found.misfits.size(); ++point) {
    double& least = profile[found.step_of(point, p)];
    least = std::min(least, found.misfits[point].deviance);
  }
  const double height = found.misfits[found.best].deviance + above;
  const auto inside_at = [&](std::size_t i) { return profile[i] <= height; };
  std::size_t first = 0, last = steps.size() - 1;
  while (!inside_at(first))
    ++first;
  while (!inside_at(last))
    --last;
  const auto crossing = [&](std::size_t in, std::size_t out) {
    const double share = (height - profile[in]) / (profile[out] - profile[in]);
    return steps[in] + share * (steps[out] - steps[in]);
  };
  Found result;
  result.value = found.value(found.best, p);
  result.low = first > 0 ? crossing(first, first - 1) : steps.front();
  result.high = last + 1 < steps.size() ? crossing(last, last + 1) : steps.back();
  result.from_end = first == 0 && steps.front() <= model.low(p);
  result.to_end = last + 1 == steps.size() && steps.back() >= model.high(p);
  return result;
}

bool uncertainties_known(std::span<const Measured> data) {
  return std::all_of(data.begin(), data.end(),
                     [](const Measured& each) { return each.standard > 0.0; });
}

/// Of the measurements from what the best fit leaves.
double variance_of(const ChartModel& model, std::span<const Measured> data, int degrees) {
  const Likelihood equal(model, data, 1.0);
  const Scan found = narrowed(equal, model, 1.0);
  return std::max(found.misfits[found.best].chi_squared / degrees,
                  std::numeric_limits<double>::min());
}

FittedLaw fit(const ChartedLaw& law, const ChartModel& model, std::span<const Measured> data) {
  FittedLaw fitted;
  fitted.name = law.name;
  fitted.degrees = static_cast<int>(data.size()) - static_cast<int>(law.parameters.size());
  const bool known = uncertainties_known(data);
  if (!known && fitted.degrees < 1)
    throw Error(Fault::case_file, "",
                fmt::format("{} measurements without uncertainties cannot tell {} parameters and "
                            "their intervals",
                            data.size(), law.parameters.size()),
                "add columns NAME_uncertainty, or measurements");
  const double variance = known ? 0.0 : variance_of(model, data, fitted.degrees);
  double above = boost::math::quantile(boost::math::chi_squared(1.0), inside);
  if (!known) {
    const double t =
        boost::math::quantile(boost::math::students_t(fitted.degrees), 0.5 * (1.0 + inside));
    above = t * t;
  }
  const Likelihood likelihood(model, data, variance);
  const Scan found = narrowed(likelihood, model, above);
  fitted.deviance = found.misfits[found.best].deviance;
  fitted.chi_squared = found.misfits[found.best].chi_squared;
  if (known && fitted.degrees > 0)
    fitted.p = boost::math::cdf(
        boost::math::complement(boost::math::chi_squared(fitted.degrees), fitted.chi_squared));
  for (std::size_t p = 0; p < law.parameters.size(); ++p) {
    fitted.parameters.push_back(interval_of(found, p, above, model));
    fitted.parameters.back().name = law.parameters[p].name;
  }
  return fitted;
}

std::vector<double> values_of(const FittedLaw& law) {
  std::vector<double> values;
  for (const Found& found : law.parameters)
    values.push_back(found.value);
  return values;
}

/// What a per cent of a quantity is in a parameter, where along the chart that is least.
double parameter_of_percent(const ChartModel& model,
                            const FittedLaw& law,
                            std::size_t p,
                            std::span<const Measured> data,
                            std::size_t quantity) {
  constexpr int steps = 20;
  constexpr double percent = 0.01;
  const double step = (model.high(p) - model.low(p)) / steps;
  std::vector<double> at = values_of(law);
  at[p] = model.low(p);
  Eigen::VectorXd before = model.values(at);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= steps; ++i) {
    at[p] = std::min(model.low(p) + i * step, model.high(p));
    const Eigen::VectorXd now = model.values(at);
    for (std::size_t d = 0; d < data.size(); ++d)
      if (const auto k = static_cast<Eigen::Index>(d); data[d].quantity == quantity)
        least = std::min(least, std::abs(percent * now[k] * step / (now[k] - before[k])));
    before = now;
  }
  return least;
}

void warn_of_law(const Chart& chart,
                 const ChartModel& model,
                 std::span<const Measured> data,
                 const FittedLaw& law,
                 Identification& into) {
  for (std::size_t p = 0; p < law.parameters.size(); ++p) {
    const Found& found = law.parameters[p];
    constexpr double wide = 0.4; // of the chart
    const bool cannot_tell = found.high - found.low > wide * (model.high(p) - model.low(p));
    if (!cannot_tell)
      continue;
    std::string text = fmt::format("law '{}': the data barely determine {}: {:.3g} to {:.3g}",
                                   law.name, found.name, found.low, found.high);
    for (std::size_t q = 0; q < chart.laws.front().quantities.size(); ++q)
      if (const double step = parameter_of_percent(model, law, p, data, q); std::isfinite(step))
        text += fmt::format("; 1 % of {} changes {} by at least {:.2g}",
                            chart.laws.front().quantities[q].name, found.name, step);
    into.warnings.push_back(std::move(text));
  }
  constexpr double hardly = 0.01;
  if (law.p && *law.p < hardly)
    into.warnings.push_back(fmt::format(
        "law '{}' does not fit: the probability that chance leaves as much is {}", law.name,
        *law.p < 1e-9 ? std::string("below 1e-9") : fmt::format("{:.1g}", *law.p)));
  for (const Found& found : law.parameters)
    if (found.from_end || found.to_end)
      into.warnings.push_back(fmt::format(
          "law '{}': the interval of {} goes to the {} of the chart, {:.4g}", law.name, found.name,
          found.to_end ? "end" : "beginning", found.to_end ? found.high : found.low));
}

/// What the chart cannot say: measurements that none of its curves comes near, errors that nobody
/// knows.
void warn_of_chart(const Chart& chart,
                   const ChartModel& model,
                   std::span<const Measured> data,
                   const ChartedLaw& law,
                   Identification& into) {
  constexpr double near = 2.0; // standard uncertainties
  for (std::size_t d = 0; d < data.size(); ++d) {
    const auto [low, high] = model.span(d);
    const double slack = near * data[d].standard;
    if (data[d].value < low - slack || data[d].value > high + slack)
      into.warnings.push_back(fmt::format(
          "law '{}': {} = {:.6g} at {} = {:.6g} lies outside of all curves of the chart, which go "
          "from {:.6g} to {:.6g} there: its interval means nothing",
          law.name, law.quantities[data[d].quantity].name, data[d].value, chart.x, data[d].x, low,
          high));
  }
  for (const std::size_t u : model.partly_known())
    into.warnings.push_back(fmt::format(
        "law '{}': what {} changes is not known for all parameters, for runs failed or stopped "
        "short; where it is not known the nearest is taken, and nothing where none is",
        law.name, chart.uncertain[u]));
  for (const Parameter& parameter : law.parameters)
    if (parameter.values.size() - model.left_out().size() < 3)
      into.warnings.push_back(fmt::format("law '{}': with two values of {} what lies between them "
                                          "is taken for a straight line, and "
                                          "its error does not count: chart three or more",
                                          law.name, parameter.name));
}

/// Standard uncertainty that a quantity is measured with, the middle of all; 0: nobody knows.
double usual_uncertainty(std::span<const Measured> data, std::size_t quantity) {
  std::vector<double> all;
  for (const Measured& each : data)
    if (each.quantity == quantity && each.standard > 0.0)
      all.push_back(each.standard);
  if (all.empty())
    return 0.0;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                   all.end());
  return all[all.size() / 2];
}

/// All places of the chart as if they had been measured.
std::vector<Measured> everywhere(const Chart& chart, const ChartedLaw& a, const ChartedLaw& b) {
  std::vector<Measured> places;
  for (std::size_t q = 0; q < a.quantities.size(); ++q)
    for (std::size_t s = 0; s < chart.stations.size(); ++s) {
      const auto reached = [&](const ChartedLaw& law) {
        return std::all_of(law.quantities[q].values.begin(), law.quantities[q].values.end(),
                           [&](const std::vector<double>& at) { return std::isfinite(at[s]); });
      };
      if (reached(a) && reached(b))
        places.push_back({q, chart.stations[s], 0.0, 0.0});
    }
  return places;
}

/// Where the best law and another one differ most, in standard uncertainties where these are known.
std::string where_they_differ(const Chart& chart,
                              std::span<const Measured> data,
                              const Identification& found,
                              std::size_t other) {
  const ChartedLaw &a = chart.laws[found.best], &b = chart.laws[other];
  const std::vector<Measured> places = everywhere(chart, a, b);
  if (places.empty())
    return {};
  const Eigen::VectorXd left =
      ChartModel(chart, a, places).values(values_of(found.laws[found.best]));
  const Eigen::VectorXd right = ChartModel(chart, b, places).values(values_of(found.laws[other]));
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double usual = usual_uncertainty(data, places[i].quantity);
    const double scale = usual > 0.0 ? usual : 0.01 * std::abs(left[k]);
    if (const double apart = std::abs(left[k] - right[k]) / scale; apart > most) {
      most = apart;
      best = i;
    }
  }
  const bool known = usual_uncertainty(data, places[best].quantity) > 0.0;
  return fmt::format(
      "'{}' and '{}' differ most in {} at {} = {:.4g}: by {:.4g}, {:.1f} {}", a.name, b.name,
      a.quantities[places[best].quantity].name, chart.x, places[best].x,
      std::abs(left[static_cast<Eigen::Index>(best)] - right[static_cast<Eigen::Index>(best)]),
      most, known ? "times the standard uncertainty" : "%");
}

/// A law is distinguished from the best one where it does not fit by itself, and is less likely by
/// a factor of 100.
void compare(const Chart& chart, std::span<const Measured> data, Identification& found) {
  const double much = 2.0 * std::log(100.0);
  constexpr double does_not_fit = 0.05;
  for (std::size_t law = 0; law < found.laws.size(); ++law) {
    const double behind = found.laws[law].deviance - found.laws[found.best].deviance;
    const bool apart = behind > much && found.laws[law].p.value_or(1.0) < does_not_fit;
    found.comparisons.push_back(law == found.best ? Comparison::preferred
                                : apart           ? Comparison::told_apart
                                                  : Comparison::undecided);
    if (law != found.best && !apart)
      if (std::string where = where_they_differ(chart, data, found, law); !where.empty())
        found.advice.push_back(std::move(where));
  }
}

} // namespace

Identification identify(const Chart& chart, const std::vector<Measured>& data) {
  if (data.empty())
    throw Error(Fault::case_file, "", "nothing has been measured");
  Identification found;
  for (const ChartedLaw& law : chart.laws) {
    const ChartModel model(chart, law, data);
    found.laws.push_back(fit(law, model, data));
    if (!model.left_out().empty())
      found.warnings.push_back(fmt::format(
          "law '{}': {} = {:.4g} is left out, its run did not reach all that was measured",
          law.name, law.parameters.front().name, fmt::join(model.left_out(), ", ")));
    warn_of_chart(chart, model, data, law, found);
    warn_of_law(chart, model, data, found.laws.back(), found);
  }
  for (std::size_t law = 1; law < found.laws.size(); ++law)
    if (found.laws[law].deviance < found.laws[found.best].deviance)
      found.best = law;
  compare(chart, data, found);
  return found;
}

} // namespace billet::study
