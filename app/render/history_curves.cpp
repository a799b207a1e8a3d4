#include "app/render/history_curves.h"

#include "app/render/load_stroke.h"
#include "geometry/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace billet::render {

namespace {

bool is_vector(std::string_view column, std::string_view what) {
  const std::size_t dot = column.rfind('.');
  const std::string_view last = dot == std::string_view::npos ? "" : column.substr(dot + 1);
  return last.size() == what.size() + 2 && last.starts_with(what) && last[what.size()] == '_';
}

/// What a column of history.csv is measured in; empty: a pure number, or a measure of the case.
std::string unit_of(std::string_view column, const CaseUnits& units) {
  const std::string per = units.per_thickness ? "/" + units.length : "";
  const std::string energy = fmt::format("{} {}{}", units.force, units.length, per);
  if (is_vector(column, "force"))
    return units.force + per;
  if (is_vector(column, "torque"))
    return energy;
  if (is_vector(column, "displacement") || column == "max_penetration")
    return units.length;
  if (column == "time" || column == "dt")
    return units.time;
  if (column == "wall_time")
    return "s";
  if (column == "volume")
    return units.length + (units.per_thickness ? "^2" : "^3");
  if (column == "contact_area")
    return units.length + (units.per_thickness ? "" : "^2");
  for (const std::string_view name : std::array<std::string_view, 4>{
           "plastic_work", "friction_work", "external_work", "elastic_energy"})
    if (column == name)
      return energy;
  return "";
}

std::string without_sign(const std::string& column) {
  return column.starts_with('-') ? column.substr(1) : column;
}

std::string label(const std::string& column, const CaseUnits& units) {
  const std::string unit = unit_of(without_sign(column), units);
  return unit.empty() ? column : fmt::format("{} [{}]", column, unit);
}

/// One name for all columns of an axis: what they are if there is one, else their unit if they
/// share it.
std::string common_label(const std::vector<std::string>& columns, const CaseUnits& units) {
  if (columns.size() == 1)
    return label(columns.front(), units);
  std::string unit = unit_of(without_sign(columns.front()), units);
  for (const std::string& column : columns)
    if (unit_of(without_sign(column), units) != unit)
      return fmt::format("{}", fmt::join(columns, ", "));
  return unit.empty() ? fmt::format("{}", fmt::join(columns, ", ")) : fmt::format("[{}]", unit);
}

} // namespace

Chart columns_of(const std::vector<std::filesystem::path>& results,
                 const std::vector<Columns>& columns) {
  Chart chart;
  std::vector<std::string> xs, ys;
  for (const std::filesystem::path& folder : results) {
    const std::filesystem::path file = folder / "history.csv";
    if (!std::filesystem::exists(file))
      throw Error(Fault::input_output, folder.string(), "the folder has no history.csv",
                  "give the folder a run wrote its results to");
    const io::CsvTable history = io::read_csv(file);
    for (const Columns& asked : columns)
      for (const std::string& column : asked.y) {
        const std::string name = results.size() > 1 ? name_of(folder) + ": " + column : column;
        chart.curves.push_back({name, false,
                                points_of(history, find_column(history, asked.x, file),
                                          find_column(history, column, file), file)});
        xs.push_back(asked.x);
        ys.push_back(column);
      }
  }
  for (std::vector<std::string>* names : {&xs, &ys}) {
    std::vector<std::string> once;
    for (const std::string& name : *names)
      if (std::find(once.begin(), once.end(), name) == once.end())
        once.push_back(name);
    *names = once;
  }
  const CaseUnits units = units_of(results.front());
  if (results.size() == 1)
    chart.title = units.title;
  chart.x_label = common_label(xs, units);
  chart.y_label = common_label(ys, units);
  return chart;
}

} // namespace billet::render
