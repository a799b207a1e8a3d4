#include "study/quantity.h"

#include "geometry/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "study/expression.h"

namespace billet::study {

namespace {

/// All numbers below a node of a JSON text, by their path.
void collect(const nlohmann::json& node,
             const std::string& path,
             std::map<std::string, double>& into) {
  if (node.is_number())
    into[path] = node.get<double>();
  else if (node.is_object())
    for (const auto& [key, value] : node.items())
      collect(value, fmt::format("{}.{}", path, key), into);
  else if (node.is_array())
    for (std::size_t i = 0; i < node.size(); ++i)
      collect(node[i], fmt::format("{}.{}", path, i), into);
}

std::map<std::string, double> numbers_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json summary = nlohmann::json::parse(stream, nullptr, false);
  if (summary.is_discarded())
    throw Error(Fault::input_output, file.string(), "the summary of the run cannot be read");
  std::map<std::string, double> numbers;
  collect(summary, "summary", numbers);
  return numbers;
}

/// Curve over x from one end to the other of a window, its ends included.
struct Window {
  std::vector<double> x, y;
};

Window window_of(std::span<const double> x,
                 std::span<const double> y,
                 const std::optional<double>& from,
                 const std::optional<double>& to) {
  Window window;
  const double low = from.value_or(-HUGE_VAL), high = to.value_or(HUGE_VAL);
  const auto add_end = [&](const std::optional<double>& end) {
    if (!end)
      return;
    if (const std::optional<double> value = curve_at(x, y, *end)) {
      window.x.push_back(*end);
      window.y.push_back(*value);
    }
  };
  const bool falls = !x.empty() && x.back() < x.front();
  add_end(falls ? to : from);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] >= low && x[i] <= high) {
      window.x.push_back(x[i]);
      window.y.push_back(y[i]);
    }
  add_end(falls ? from : to);
  return window;
}

double mean(const Window& window) {
  double area = 0.0, length = 0.0;
  for (std::size_t i = 1; i < window.x.size(); ++i) {
    const double step = window.x[i] - window.x[i - 1];
    area += 0.5 * step * (window.y[i] + window.y[i - 1]);
    length += step;
  }
  return length != 0.0 ? area / length : window.y.front();
}

double evaluate_expression(const Quantity& quantity, const std::map<std::string, double>& before) {
  std::vector<std::string> names(before.size());
  std::transform(before.begin(), before.end(), names.begin(),
                 [](const auto& each) { return each.first; });
  const Expression expression(quantity.expression, names);
  std::vector<double> values;
  for (const std::size_t i : expression.used())
    values.push_back(before.at(names[i]));
  return expression(values);
}

} // namespace

Results::Results(const std::filesystem::path& folder)
    : folder_(folder), history_(io::read_csv(folder / "history.csv")),
      summary_(numbers_of(folder / "summary.json")) {}

std::optional<double> Results::summary(const std::string& path) const {
  const auto found = summary_.find("summary." + path);
  return found != summary_.end() ? std::optional(found->second) : std::nullopt;
}

std::vector<double> Results::values(const std::string& text) const {
  std::vector<std::string> names = history_.columns;
  std::vector<double> constants;
  for (const auto& [path, number] : summary_) {
    names.push_back(path);
    constants.push_back(number);
  }
  const Expression expression(text, names);
  std::vector<std::vector<double>> columns;
  for (const std::size_t i : expression.used())
    columns.push_back(
        i < history_.columns.size()
            ? history_.numbers(i)
            : std::vector<double>(history_.rows.size(), constants[i - history_.columns.size()]));
  std::vector<double> result(history_.rows.size());
  std::vector<double> row(columns.size());
  for (std::size_t r = 0; r < result.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      row[c] = columns[c][r];
    result[r] = expression(row);
  }
  return result;
}

std::optional<double> curve_at(std::span<const double> x, std::span<const double> y, double at) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    constexpr double rounding = 1e-9;
    if (std::abs(x[i] - at) <= rounding * std::abs(at))
      return y[i];
    if (i > 0 && (x[i - 1] - at) * (x[i] - at) < 0.0)
      return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  }
  return std::nullopt;
}

double mean_between(std::span<const double> x, std::span<const double> y, double from, double to) {
  const Window window = window_of(x, y, from, to);
  return window.x.empty() ? std::nan("") : mean(window);
}

double evaluate(const Quantity& quantity,
                const Results& results,
                const std::map<std::string, double>& before) {
  if (!quantity.expression.empty())
    return evaluate_expression(quantity, before);
  const std::vector<double> y = results.values(quantity.of);
  if (y.empty())
    throw Error(Fault::case_file, "",
                fmt::format("quantity '{}': the run has no increment", quantity.name));
  if (quantity.take == Quantity::Take::end)
    return y.back();
  const std::vector<double> x = results.values(quantity.over);
  if (quantity.take == Quantity::Take::at) {
    if (const std::optional<double> value = curve_at(x, y, *quantity.at))
      return *value;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    throw Error(
        Fault::case_file, "",
        fmt::format("quantity '{}': {} goes from {:.6g} to {:.6g} and does not reach {:.6g}",
                    quantity.name, quantity.over, *low, *high, *quantity.at));
  }
  const Window window = window_of(x, y, quantity.from, quantity.to);
  if (window.x.empty())
    throw Error(Fault::case_file, "",
                fmt::format("quantity '{}': the run has nothing between {} = {} and {}",
                            quantity.name, quantity.over, quantity.from.value_or(-HUGE_VAL),
                            quantity.to.value_or(HUGE_VAL)));
  if (quantity.take == Quantity::Take::mean)
    return mean(window);
  const auto [low, high] = std::minmax_element(window.y.begin(), window.y.end());
  return quantity.take == Quantity::Take::largest ? *high : *low;
}

} // namespace billet::study
