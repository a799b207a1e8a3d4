// Measurements as they are read, and what was found as it is written.

#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/text/csv_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/identify.h"

namespace billet::study {

namespace {

constexpr double half_width_of_95 = 1.96; // in standard deviations

std::string interval_in_words(const Found& found) {
  return fmt::format("{} = {:.4g}, 95 %: {}{:.4g} to {:.4g}{}", found.name, found.value,
                     found.from_end ? "(beginning of the chart) " : "", found.low, found.high,
                     found.to_end ? " (end of the chart)" : "");
}

std::string in_words(Comparison comparison) {
  switch (comparison) {
  case Comparison::preferred:
    return "likeliest";
  case Comparison::undecided:
    return "not told apart from the likeliest";
  case Comparison::told_apart:
    return "told apart: does not fit";
  }
  return {};
}

/// Columns of one quantity.
struct Columns {
  std::size_t quantity;
  std::size_t value;
  std::optional<std::size_t> standard, uncertainty;
};

std::vector<Columns> columns_of(const io::CsvTable& table, const Chart& chart) {
  std::vector<Columns> columns;
  const std::vector<ChartedQuantity>& quantities = chart.laws.front().quantities;
  for (std::size_t q = 0; q < quantities.size(); ++q)
    if (const std::optional<std::size_t> value = table.find(quantities[q].name))
      columns.push_back({q, *value, table.find(quantities[q].name + "_standard"),
                         table.find(quantities[q].name + "_uncertainty")});
  return columns;
}

void check_columns(const io::CsvTable& table,
                   const Chart& chart,
                   const std::string& file,
                   std::vector<Complaint>& complaints) {
  std::vector<std::string> known{chart.x};
  for (const ChartedQuantity& quantity : chart.laws.front().quantities)
    for (const char* ending : {"", "_standard", "_uncertainty"})
      known.push_back(quantity.name + ending);
  for (const std::string& column : std::set(table.columns.begin(), table.columns.end())) {
    if (std::find(known.begin(), known.end(), column) == known.end())
      complaints.push_back({file, fmt::format("the chart knows no column '{}'", column),
                            io::suggestion(column, known)});
    if (std::count(table.columns.begin(), table.columns.end(), column) > 1)
      complaints.push_back({file, fmt::format("there is more than one column '{}'", column), {}});
  }
  for (const Columns& each : columns_of(table, chart))
    if (each.standard && each.uncertainty)
      complaints.push_back({file,
                            fmt::format("'{0}_standard' and '{0}_uncertainty' say the same",
                                        table.columns[each.value]),
                            "leave one of them out"});
}

} // namespace

std::vector<Measured> read_measurements(const std::filesystem::path& file, const Chart& chart) {
  const io::CsvTable table = io::read_csv(file);
  if (table.columns.size() == 1 && table.columns.front().find_first_of(";\t") != std::string::npos)
    throw Error(Fault::case_file, file.string(),
                "its columns are separated by semicolons or tabulators",
                "needed are commas between columns, and points in decimals");
  std::vector<Complaint> complaints;
  check_columns(table, chart, file.string(), complaints);
  const std::optional<std::size_t> x = table.find(chart.x);
  const std::vector<Columns> columns = columns_of(table, chart);
  if (!x)
    complaints.push_back({file.string(), fmt::format("there is no column '{}'", chart.x),
                          "it says how far the test had gone"});
  if (columns.empty())
    complaints.push_back({file.string(), "there is no column of what the chart measures", {}});
  if (!complaints.empty())
    throw Error(Fault::case_file, std::move(complaints));
  constexpr double largest_uncertainty = 1e100; // its square is a number
  std::vector<Measured> data;
  const std::vector<double> places = table.numbers(*x);
  for (const Columns& each : columns) {
    const std::vector<double> values = table.numbers(each.value);
    std::vector<double> standards(values.size(), 0.0);
    if (each.standard)
      standards = table.numbers(*each.standard);
    else if (each.uncertainty)
      for (std::size_t r = 0; r < values.size(); ++r)
        standards[r] = table.numbers(*each.uncertainty)[r] / half_width_of_95;
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (table.rows[r][each.value].empty())
        continue; // not measured there
      const auto complain = [&](std::size_t column, const char* allowed) {
        complaints.push_back({file.string(),
                              fmt::format("row {}: {} is \"{}\", allowed is {}", r + 1,
                                          table.columns[column], table.rows[r][column], allowed),
                              {}});
      };
      if (!std::isfinite(places[r]))
        complain(*x, "a number");
      if (!std::isfinite(values[r]))
        complain(each.value, "a number");
      if (const std::optional<std::size_t> uncertainty =
              each.standard ? each.standard : each.uncertainty;
          uncertainty && !(standards[r] > 0.0 && standards[r] < largest_uncertainty))
        complain(*uncertainty, "a number above 0, and below 1e100");
      data.push_back({each.quantity, places[r], values[r], standards[r]});
    }
  }
  const auto known = std::count_if(data.begin(), data.end(),
                                   [](const Measured& each) { return each.standard > 0.0; });
  if (known != 0 && known != static_cast<std::ptrdiff_t>(data.size()))
    complaints.push_back({file.string(),
                          "some measured values have an uncertainty and some have none",
                          "give all of them one"});
  if (data.empty())
    complaints.push_back(
        {file.string(), "nothing has been measured: there is no row with a value", {}});
  if (!complaints.empty())
    throw Error(Fault::case_file, std::move(complaints));
  return data;
}

std::string in_words(const Identification& found) {
  std::string text;
  for (std::size_t law = 0; law < found.laws.size(); ++law) {
    const FittedLaw& each = found.laws[law];
    for (const Found& parameter : each.parameters)
      text += fmt::format("{}: {}\n", each.name, interval_in_words(parameter));
    text += fmt::format("{}: chi squared {:.3g} of {} degrees of freedom{}{}\n", each.name,
                        each.chi_squared, each.degrees,
                        each.p ? fmt::format(", p = {:.2g}", *each.p) : "",
                        found.laws.size() > 1 ? "; " + in_words(found.comparisons[law]) : "");
  }
  for (const std::string& warning : found.warnings)
    text += "warning: [identification] " + warning + "\n";
  for (const std::string& advice : found.advice)
    text += "a further measurement: " + advice + "\n";
  return text;
}

std::string json_text(const Identification& found) {
  nlohmann::ordered_json laws = nlohmann::ordered_json::array();
  for (std::size_t law = 0; law < found.laws.size(); ++law) {
    const FittedLaw& each = found.laws[law];
    nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
    for (const Found& parameter : each.parameters)
      parameters.push_back({{"name", parameter.name},
                            {"value", parameter.value},
                            {"low", parameter.low},
                            {"high", parameter.high},
                            {"from_beginning_of_chart", parameter.from_end},
                            {"to_end_of_chart", parameter.to_end}});
    laws.push_back({{"name", each.name},
                    {"parameters", parameters},
                    {"deviance", each.deviance},
                    {"chi_squared", each.chi_squared},
                    {"degrees_of_freedom", each.degrees},
                    {"p", each.p ? nlohmann::ordered_json(*each.p) : nlohmann::ordered_json()},
                    {"comparison", in_words(found.comparisons[law])}});
  }
  return nlohmann::ordered_json{{"laws", laws},
                                {"likeliest", found.laws[found.best].name},
                                {"warnings", found.warnings},
                                {"advice", found.advice}}
             .dump(2) +
         "\n";
}

} // namespace billet::study
