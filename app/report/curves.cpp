#include "app/report/curves.h"

#include "app/render/load_stroke.h"
#include "geometry/base/error.h"
#include "io/case/history_columns.h"
#include "io/text/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace billet::report {

namespace {

using render::Chart;
using render::Curve;

std::string with_unit(std::string_view quantity, std::string_view unit) {
  return fmt::format("{} [{}]", quantity, unit);
}

/// A column over another; rows that lack a number are left out.
Curve curve_of(const io::CsvTable& table,
               std::string_view x,
               std::string_view y,
               std::string label,
               double factor = 1.0) {
  const std::vector<double> abscissae = column(table, x), ordinates = column(table, y);
  Curve curve{std::move(label), false, {}};
  for (std::size_t i = 0; i < std::min(abscissae.size(), ordinates.size()); ++i)
    if (std::isfinite(abscissae[i]) && std::isfinite(ordinates[i]))
      curve.values.emplace_back(abscissae[i], factor * ordinates[i]);
  return curve;
}

void add_if_any(std::vector<NamedChart>& charts, NamedChart chart) {
  std::erase_if(chart.chart.curves, [](const Curve& curve) { return curve.values.empty(); });
  if (!chart.chart.curves.empty())
    charts.push_back(std::move(chart));
}

NamedChart loads_over_strokes(const ResultsFolder& results) {
  try {
    NamedChart named{"load-stroke", render::load_stroke({results.path}), false, false};
    named.over_time = named.chart.x_label.starts_with("time");
    named.chart.title = named.over_time ? "Forces over time" : "Forces over strokes";
    return named;
  } catch (const Error&) { // no tools, or no rows so far
    return {};
  }
}

double largest_in(const std::vector<Curve>& curves) {
  double largest = 0.0;
  for (const Curve& curve : curves)
    for (const Vec2& value : curve.values)
      largest = std::max(largest, std::abs(value[1]));
  return largest;
}

/// Magnitudes of three columns NAME_x, _y, _z over time, of each tool.
NamedChart of_tools_over_time(const ResultsFolder& results,
                              const std::string& what,
                              const std::string& title,
                              std::string_view unit) {
  NamedChart named{what + "-time", {{}, title, {}, {}}, false, true};
  const std::vector<double> times = column(results.history, "time");
  for (const std::string& tool : results.tools()) {
    Curve curve{tool, false, {}};
    const std::string stem = tool + "." + what;
    const std::vector<double> x = column(results.history, stem + "_x"),
                              y = column(results.history, stem + "_y"),
                              z = column(results.history, stem + "_z");
    for (std::size_t i = 0; i < times.size() && i < z.size(); ++i)
      curve.values.emplace_back(times[i], Vec3(x[i], y[i], z[i]).norm());
    named.chart.curves.push_back(std::move(curve));
  }
  const io::Readable readable = io::readable(largest_in(named.chart.curves), unit);
  for (Curve& curve : named.chart.curves)
    for (Vec2& value : curve.values)
      value[1] *= readable.factor;
  named.chart.x_label = with_unit("time", results.units().time);
  named.chart.y_label = with_unit(what, results.of_whole(readable.unit));
  return named;
}

/// N mm in J, which everybody reads; other systems have their own.
std::pair<double, std::string> unit_of_energy(const io::UnitSystem& units) {
  constexpr double joule = 1e-3;
  if (units.force == "N" && units.length == "mm")
    return {joule, "J"};
  if (units.force == "N" && units.length == "m")
    return {1.0, "J"};
  return {1.0, units.force + " " + units.length};
}

NamedChart energies(const ResultsFolder& results) {
  NamedChart named{"energies", {{}, "Energies", {}, {}}, false, true};
  const auto [factor, unit] = unit_of_energy(results.units());
  for (const auto& [key, label] :
       {std::pair{"external_work", "external work"}, std::pair{"plastic_work", "plastic work"},
        std::pair{"friction_work", "friction work"}, std::pair{"elastic_energy", "elastic energy"}})
    named.chart.curves.push_back(curve_of(results.history, "time", key, label, factor));
  named.chart.x_label = with_unit("time", results.units().time);
  const bool per_thickness = results.facts.analysis == io::Analysis::plane_strain;
  named.chart.y_label =
      with_unit(per_thickness ? "energy per thickness" : "energy", results.of_whole(unit));
  return named;
}

NamedChart over_time(const ResultsFolder& results,
                     const std::string& id,
                     const std::string& title,
                     const std::vector<std::pair<std::string, std::string>>& columns,
                     const std::string& y_label) {
  NamedChart named{id, {{}, title, {}, {}}, false, true};
  for (const auto& [key, label] : columns)
    named.chart.curves.push_back(curve_of(results.history, "time", key, label));
  named.chart.x_label = with_unit("time", results.units().time);
  named.chart.y_label = y_label;
  return named;
}

/// Residual of every iteration, one after the other.
NamedChart residuals(const ResultsFolder& results) {
  NamedChart named{"residuals", {{}, "Residual of each iteration", {}, {}}, true, false};
  Curve curve{"residual", false, {}};
  double number = 0.0;
  for (const double residual : column(results.iterations, "residual")) {
    number += 1.0;
    if (residual > 0.0 && std::isfinite(residual))
      curve.values.emplace_back(number, residual);
  }
  named.chart.curves.push_back(std::move(curve));
  named.chart.x_label = "iteration of the run";
  named.chart.y_label = "relative residual [-]";
  return named;
}

void add_measures(std::vector<NamedChart>& charts, const ResultsFolder& results) {
  for (std::size_t c = io::fixed_columns.size(); c < results.history.columns.size(); ++c) {
    const std::string& name = results.history.columns[c];
    const bool is_tool = name.find('.') != std::string::npos;
    if (!is_tool)
      add_if_any(charts,
                 over_time(results, "measure-" + name, "Measure: " + name, {{name, name}}, name));
  }
}

} // namespace

std::vector<Vec2> thinned(const std::vector<Vec2>& values, std::size_t most) {
  if (values.size() <= most || most < 4)
    return values;
  std::vector<Vec2> kept;
  const std::size_t stretches = most / 2 - 1;
  kept.push_back(values.front());
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto first = values.begin() + static_cast<long>(s * values.size() / stretches);
    const auto last = values.begin() + static_cast<long>((s + 1) * values.size() / stretches);
    const auto [low, high] =
        std::minmax_element(first, last, [](const Vec2& a, const Vec2& b) { return a[1] < b[1]; });
    kept.push_back(*std::min(low, high));
    if (low != high)
      kept.push_back(*std::max(low, high));
  }
  kept.push_back(values.back());
  return kept;
}

std::vector<NamedChart> curves_of(const ResultsFolder& results) {
  const io::UnitSystem units = results.units();
  std::vector<NamedChart> charts;
  NamedChart loads = loads_over_strokes(results);
  const bool travels = !loads.over_time;
  add_if_any(charts, std::move(loads));
  if (travels)
    add_if_any(charts, of_tools_over_time(results, "force", "Forces over time", units.force));
  NamedChart torques =
      of_tools_over_time(results, "torque", "Torques over time", units.force + " " + units.length);
  if (results.facts.tools_turn)
    add_if_any(charts, std::move(torques));
  add_if_any(charts, energies(results));
  add_if_any(charts, over_time(results, "penetration", "Certificate of penetration",
                               {{"max_penetration", "bound"}},
                               with_unit("deepest point of any face", units.length)));
  add_if_any(charts,
             over_time(results, "iterations", "Iterations of each increment",
                       {{"iterations", "iterations"}, {"cutbacks", "cut-backs"}}, "number"));
  add_if_any(charts, over_time(results, "increments", "Length of increments", {{"dt", "dt"}},
                               with_unit("increment", units.time)));
  add_if_any(charts, residuals(results));
  add_if_any(charts, over_time(results, "quality", "Quality of the worst element",
                               {{"min_quality", "scaled Jacobian"}}, "scaled Jacobian [-]"));
  add_if_any(charts, over_time(results, "strain", "Largest plastic strain",
                               {{"max_plastic_strain", "plastic strain"}}, "plastic strain [-]"));
  add_measures(charts, results);
  return charts;
}

} // namespace billet::report
