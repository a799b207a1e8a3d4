// chart.json, chart.csv and the pictures of a chart.

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"
#include "io/text/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "study/chart.h"
#include "study/file_text.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using Rows = std::vector<std::vector<double>>;

/// JSON has no word for what is not a number: null.
ordered_json rows_to_json(const Rows& rows) {
  ordered_json list = ordered_json::array();
  for (const std::vector<double>& row : rows) {
    ordered_json values = ordered_json::array();
    for (const double value : row)
      values.push_back(std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr));
    list.push_back(std::move(values));
  }
  return list;
}

Rows rows_of_json(const nlohmann::json& list) {
  Rows rows;
  for (const nlohmann::json& row : list) {
    std::vector<double>& values = rows.emplace_back();
    for (const nlohmann::json& value : row)
      values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : value.get<double>());
  }
  return rows;
}

ordered_json law_to_json(const ChartedLaw& law) {
  ordered_json parameters = ordered_json::array(), quantities = ordered_json::array();
  for (const Parameter& parameter : law.parameters)
    parameters.push_back(
        {{"name", parameter.name}, {"keys", parameter.keys}, {"values", parameter.values}});
  for (const ChartedQuantity& quantity : law.quantities) {
    ordered_json change = ordered_json::array();
    for (const Rows& each : quantity.change)
      change.push_back(rows_to_json(each));
    quantities.push_back({{"name", quantity.name},
                          {"values", rows_to_json(quantity.values)},
                          {"model_error", rows_to_json(quantity.model_error)},
                          {"change", change}});
  }
  return {{"name", law.name}, {"parameters", parameters}, {"quantities", quantities}};
}

ChartedLaw law_of_json(const nlohmann::json& from) {
  ChartedLaw law;
  law.name = from.at("name");
  for (const nlohmann::json& each : from.at("parameters"))
    law.parameters.push_back({each.at("name"), each.at("keys"), each.at("values")});
  for (const nlohmann::json& each : from.at("quantities")) {
    ChartedQuantity quantity{
        each.at("name"), rows_of_json(each.at("values")), rows_of_json(each.at("model_error")), {}};
    for (const nlohmann::json& change : each.at("change"))
      quantity.change.push_back(rows_of_json(change));
    law.quantities.push_back(std::move(quantity));
  }
  return law;
}

bool increases(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool has_shape(const Rows& rows, std::size_t n_rows, std::size_t n_columns) {
  return rows.size() == n_rows &&
         std::all_of(rows.begin(), rows.end(),
                     [&](const std::vector<double>& row) { return row.size() == n_columns; });
}

/// Whether a law has values wherever others look for them.
bool is_whole(const Chart& chart, const ChartedLaw& law) {
  constexpr std::size_t most_parameters = 2, least_values = 2;
  std::size_t n_points = 1;
  for (const Parameter& parameter : law.parameters) {
    if (parameter.values.size() < least_values || !increases(parameter.values))
      return false;
    n_points *= parameter.values.size();
  }
  const std::vector<ChartedQuantity>& first = chart.laws.front().quantities;
  if (law.parameters.empty() || law.parameters.size() > most_parameters || law.quantities.empty() ||
      law.quantities.size() != first.size())
    return false;
  for (std::size_t q = 0; q < first.size(); ++q) {
    const ChartedQuantity& quantity = law.quantities[q];
    const auto fits = [&](const Rows& rows) {
      return has_shape(rows, n_points, chart.stations.size());
    };
    if (quantity.name != first[q].name || quantity.change.size() != chart.uncertain.size() ||
        !fits(quantity.values) || !fits(quantity.model_error) ||
        !std::all_of(quantity.change.begin(), quantity.change.end(), fits))
      return false;
  }
  return true;
}

/// One row per point of a law's grid and station.
std::string chart_csv(const Chart& chart) {
  std::string text = fmt::format("law,parameter_1,parameter_2,{}", io::csv_cell(chart.x));
  for (const ChartedQuantity& quantity : chart.laws.front().quantities)
    text += fmt::format(",{0},{0}.model_error", io::csv_cell(quantity.name));
  text += '\n';
  const auto cell = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.10g}", value) : std::string();
  };
  for (const ChartedLaw& law : chart.laws)
    for (std::size_t point = 0; point < law.quantities.front().values.size(); ++point)
      for (std::size_t s = 0; s < chart.stations.size(); ++s) {
        const std::size_t n_last = law.parameters.back().values.size();
        const bool two = law.parameters.size() == 2;
        text += fmt::format(
            "{},{:.10g},{},{:.10g}", io::csv_cell(law.name),
            two ? law.parameters[0].values[point / n_last] : law.parameters[0].values[point],
            two ? cell(law.parameters[1].values[point % n_last]) : "", chart.stations[s]);
        for (const ChartedQuantity& quantity : law.quantities)
          text += fmt::format(",{},{}", cell(quantity.values[point][s]),
                              cell(quantity.model_error[point][s]));
        text += '\n';
      }
  return text;
}

/// Writes a curve; its series for billet-render.
std::string curve_file(const fs::path& file,
                       const std::vector<double>& x,
                       const std::vector<double>& y,
                       const std::string& label) {
  std::string text = "x,y\n";
  bool any = false;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(y[i])) {
      text += fmt::format("{:.10g},{:.10g}\n", x[i], y[i]);
      any = true;
    }
  if (!any)
    return {};
  io::write_file(file, text);
  return fmt::format("{}:x:y:{}", file.string(), label);
}

} // namespace

void write_chart(const Chart& chart, const fs::path& folder) {
  ordered_json laws = ordered_json::array();
  for (const ChartedLaw& law : chart.laws)
    laws.push_back(law_to_json(law));
  const ordered_json whole{{"title", chart.title},
                           {"x", chart.x},
                           {"stations", chart.stations},
                           {"uncertain", chart.uncertain},
                           {"laws", laws}};
  io::write_file(folder / "chart.json", whole.dump(1) + "\n");
  io::write_file(folder / "chart.csv", chart_csv(chart));
}

Chart read_chart(const fs::path& file) {
  const nlohmann::json from = nlohmann::json::parse(text_of_file(file), nullptr, false);
  const auto refuse = [&](const std::string& why) {
    return Error(Fault::input_output, file.string(), "this is no chart: " + why,
                 "make one with billet chart CHART.toml");
  };
  if (!from.is_object())
    throw refuse("no JSON object");
  try {
    Chart chart;
    chart.title = from.at("title");
    chart.x = from.at("x");
    chart.stations = from.at("stations").get<std::vector<double>>();
    chart.uncertain = from.at("uncertain").get<std::vector<std::string>>();
    for (const nlohmann::json& law : from.at("laws"))
      chart.laws.push_back(law_of_json(law));
    if (chart.laws.empty() || chart.stations.empty() || !increases(chart.stations) ||
        !std::all_of(chart.laws.begin(), chart.laws.end(),
                     [&](const ChartedLaw& law) { return is_whole(chart, law); }))
      throw refuse("parts of it are missing");
    return chart;
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error.what());
  }
}

std::vector<std::vector<std::string>> chart_pictures(const Chart& chart, const fs::path& folder) {
  const fs::path curves = folder / "charts";
  io::make_folder(curves);
  std::vector<std::vector<std::string>> pictures;
  constexpr std::size_t most_curves = 7;
  const auto add = [&](const std::string& name, const std::string& x, const std::string& y,
                       const std::vector<std::string>& series) {
    if (series.empty())
      return;
    std::vector<std::string> words{"--curve", "--tight"};
    words.insert(words.end(), series.begin(), series.end());
    for (const std::string& word :
         {std::string("--x-label"), x, std::string("--y-label"), y, std::string("--title"),
          chart.title, std::string("-o"), (folder / (name + ".png")).string()})
      words.push_back(word);
    pictures.push_back(std::move(words));
  };
  for (const ChartedLaw& law : chart.laws) {
    if (law.parameters.size() > 1)
      continue;
    const Parameter& parameter = law.parameters.front();
    for (const ChartedQuantity& quantity : law.quantities) {
      const std::string name = fmt::format("{}-{}", law.name, quantity.name);
      std::vector<std::string> over_x, over_parameter;
      for (std::size_t p = 0; p < parameter.values.size() && over_x.size() < most_curves; ++p)
        if (std::string each = curve_file(
                curves / fmt::format("{}-{}.csv", name, p), chart.stations, quantity.values[p],
                fmt::format("{} = {:.4g}", parameter.name, parameter.values[p]));
            !each.empty())
          over_x.push_back(std::move(each));
      const std::size_t step = chart.stations.size() / most_curves + 1;
      for (std::size_t s = chart.stations.size(); s > 0; s = s > step ? s - step : 0) {
        std::vector<double> values;
        for (const std::vector<double>& at : quantity.values)
          values.push_back(at[s - 1]);
        if (std::string each =
                curve_file(curves / fmt::format("{}-at-{}.csv", name, s), parameter.values, values,
                           fmt::format("{} = {:.4g}", chart.x, chart.stations[s - 1]));
            !each.empty())
          over_parameter.push_back(std::move(each));
      }
      add(name, chart.x, quantity.name, over_x);
      add(name + "-over-" + parameter.name, parameter.name, quantity.name, over_parameter);
    }
  }
  return pictures;
}

} // namespace billet::study
