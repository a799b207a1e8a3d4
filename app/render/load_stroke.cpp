#include "app/render/load_stroke.h"

#include "geometry/base/error.h"
#include "io/case/quoted.h"
#include "io/text/csv_table.h"
#include "io/text/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace billet::render {

namespace {

/// The text that a key at the head of a resolved case has; empty: it is not there.
std::string text_of(const std::filesystem::path& resolved, const std::string& key) {
  std::ifstream stream(resolved);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t equals = line.find('=');
    const std::size_t first = line.find('"'), last = line.rfind('"');
    if (line.starts_with(key) && equals != std::string::npos && first > equals && last > first &&
        line.find_first_not_of(' ', key.size()) == equals)
      return io::unquoted(std::string_view(line).substr(first, last - first + 1));
  }
  return {};
}

/// Forces on a tool and its ways, one row per increment.
struct Record {
  std::string name;
  std::vector<Vec3> forces;
  std::vector<Vec3> ways;
  Vec3 direction = Vec3::Zero(); ///< of the longest way; zero: it does not travel
};

/// Vectors whose components are columns next to each other, one row per increment.
std::vector<Vec3> vectors(const io::CsvTable& history, std::size_t first) {
  std::vector<Vec3> result(history.rows.size());
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double> column = history.numbers(first + i);
    for (std::size_t row = 0; row < result.size(); ++row)
      result[row][static_cast<Eigen::Index>(i)] = column[row];
  }
  return result;
}

std::vector<Record> records_of(const io::CsvTable& history) {
  constexpr std::string_view suffix = ".force_x";
  std::vector<Record> records;
  for (std::size_t column = 0; column < history.columns.size(); ++column) {
    const std::string& heading = history.columns[column];
    if (!heading.ends_with(suffix))
      continue;
    Record record{heading.substr(0, heading.size() - suffix.size()), {}, {}};
    const std::optional<std::size_t> way = history.find(record.name + ".displacement_x");
    if (!way || *way + 2 >= history.columns.size())
      continue;
    record.forces = vectors(history, column);
    record.ways = vectors(history, *way);
    double longest = 0.0;
    for (const Vec3& along : record.ways)
      if (const double length = along.norm(); length > longest) {
        longest = length;
        record.direction = along / length;
      }
    records.push_back(std::move(record));
  }
  return records;
}

Curve over_stroke(const Record& record) {
  Curve curve{record.name, false, {Vec2::Zero()}};
  for (std::size_t i = 0; i < record.ways.size(); ++i)
    curve.values.emplace_back(record.ways[i].dot(record.direction),
                              -record.forces[i].dot(record.direction));
  return curve;
}

Curve over_time(const Record& record, std::span<const double> times) {
  Curve curve{record.name, false, {Vec2::Zero()}};
  for (std::size_t i = 0; i < record.forces.size(); ++i)
    curve.values.emplace_back(times[i], record.forces[i].norm());
  return curve;
}

/// Puts one coordinate of all curves into a unit in which it reads well; its name.
std::string rescale(std::vector<Curve>& curves, int axis, const std::string& unit) {
  double largest = 0.0;
  for (const Curve& curve : curves)
    for (const Vec2& value : curve.values)
      largest = std::max(largest, std::abs(value[axis]));
  const io::Readable readable = io::readable(largest, unit);
  for (Curve& curve : curves)
    for (Vec2& value : curve.values)
      value[axis] *= readable.factor;
  return readable.unit;
}

/// The forces of one run.
struct Loads {
  std::vector<Curve> curves;
  bool travels = false; ///< over strokes, not over time
  CaseUnits units;
};

Loads loads_of(const std::filesystem::path& results) {
  const std::filesystem::path file = results / "history.csv";
  if (!std::filesystem::exists(file))
    throw Error(Fault::input_output, results.string(), "the folder has no history.csv",
                "give the folder a run wrote its results to");
  const io::CsvTable history = io::read_csv(file);
  const std::vector<Record> records = records_of(history);
  Loads loads{{}, false, units_of(results)};
  for (const Record& record : records)
    if (!record.direction.isZero(0.0))
      loads.curves.push_back(over_stroke(record));
  loads.travels = !loads.curves.empty();
  if (!loads.travels && history.find("time")) {
    const std::vector<double> times = history.numbers(*history.find("time"));
    for (const Record& record : records)
      loads.curves.push_back(over_time(record, times));
  }
  if (history.rows.empty())
    throw Error(Fault::input_output, file.string(), "the run has no increments: there is no curve",
                "summary.json says how it ended");
  if (loads.curves.empty())
    throw Error(Fault::input_output, file.string(), "the table has no forces of tools",
                "billet render RESULTS --curve time:plastic_work draws any of its columns");
  return loads;
}

} // namespace

CaseUnits units_of(const std::filesystem::path& results) {
  const std::filesystem::path resolved = results / "case.resolved.toml";
  CaseUnits units{"mm", "N", "s", text_of(resolved, "title"),
                  text_of(resolved, "analysis") == "plane-strain"};
  if (text_of(resolved, "units").starts_with("m-"))
    units.length = "m";
  return units;
}

std::vector<std::pair<double, double>> longest_way(const std::filesystem::path& results) {
  const std::filesystem::path file = results / "history.csv";
  if (!std::filesystem::exists(file))
    return {};
  const io::CsvTable history = io::read_csv(file);
  const std::optional<std::size_t> time = history.find("time");
  const std::vector<Record> records = records_of(history);
  const auto reach = [](const Record& record) {
    double longest = 0.0;
    for (const Vec3& way : record.ways)
      longest = std::max(longest, way.norm());
    return longest;
  };
  const auto farthest =
      std::max_element(records.begin(), records.end(),
                       [&](const Record& a, const Record& b) { return reach(a) < reach(b); });
  if (!time || farthest == records.end() || farthest->direction.isZero(0.0))
    return {};
  std::vector<std::pair<double, double>> result{{0.0, 0.0}};
  const std::vector<double> times = history.numbers(*time);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (const double way = farthest->ways[i].dot(farthest->direction);
        std::isfinite(way) && std::isfinite(times[i]))
      result.emplace_back(times[i], way);
  return result;
}

std::string name_of(const std::filesystem::path& results) {
  std::filesystem::path path = std::filesystem::absolute(results).lexically_normal();
  if (!path.has_filename())
    path = path.parent_path();
  return path.filename().string();
}

Chart load_stroke(const std::vector<std::filesystem::path>& results) {
  Chart chart;
  std::optional<Loads> first;
  for (const std::filesystem::path& folder : results) {
    Loads loads = loads_of(folder);
    if (first && (loads.travels != first->travels || loads.units.length != first->units.length ||
                  loads.units.per_thickness != first->units.per_thickness))
      throw Error(
          Fault::usage, folder.string(),
          fmt::format("its forces have other axes than those of {}", results.front().string()),
          "draw columns: --curve X:Y, or a chart of its own");
    for (Curve& curve : loads.curves) {
      if (results.size() > 1)
        curve.label = fmt::format("{}: {}", name_of(folder), curve.label);
      chart.curves.push_back(std::move(curve));
    }
    if (!first)
      first = std::move(loads);
  }
  const CaseUnits& units = first->units;
  if (results.size() == 1)
    chart.title = units.title;
  chart.x_label = first->travels
                      ? fmt::format("stroke [{}]", rescale(chart.curves, 0, units.length))
                      : fmt::format("time [{}]", units.time);
  const std::string force = rescale(chart.curves, 1, units.force);
  chart.y_label = units.per_thickness
                      ? fmt::format("force per thickness [{}/{}]", force, units.length)
                      : fmt::format("force [{}]", force);
  return chart;
}

} // namespace billet::render
