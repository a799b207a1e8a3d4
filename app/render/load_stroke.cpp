#include "app/render/load_stroke.h"

#include "geometry/base/error.h"
#include "io/text/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

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
      return line.substr(first + 1, last - first - 1);
  }
  return {};
}

/// What the case measures in.
struct CaseUnits {
  std::string length, force, time;
  bool per_thickness = false; ///< forces in plane strain
};

CaseUnits units_of(const std::filesystem::path& results) {
  const std::filesystem::path resolved = results / "case.resolved.toml";
  const std::string system = text_of(resolved, "units");
  CaseUnits units{"mm", "N", "s", text_of(resolved, "analysis") == "plane-strain"};
  if (system.starts_with("m-"))
    units.length = "m";
  return units;
}

/// Forces on a tool and its ways, a row an increment.
struct Record {
  std::string name;
  std::vector<Vec3> forces;
  std::vector<Vec3> ways;
  Vec3 direction = Vec3::Zero(); ///< of the longest way; zero: it does not travel
};

std::vector<Record> records_of(const Table& history) {
  constexpr std::string_view suffix = ".force_x";
  std::vector<Record> records;
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find(history.columns.begin(), history.columns.end(), name) - history.columns.begin());
  };
  for (const std::string& heading : history.columns) {
    if (!heading.ends_with(suffix))
      continue;
    Record record{heading.substr(0, heading.size() - suffix.size()), {}, {}};
    const std::size_t force = column(heading), way = column(record.name + ".displacement_x");
    if (way + 2 >= history.columns.size())
      continue;
    double longest = 0.0;
    for (const std::vector<double>& row : history.rows) {
      record.forces.emplace_back(row[force], row[force + 1], row[force + 2]);
      record.ways.emplace_back(row[way], row[way + 1], row[way + 2]);
      if (const double length = record.ways.back().norm(); length > longest) {
        longest = length;
        record.direction = record.ways.back() / length;
      }
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

Curve over_time(const Record& record, const Table& history) {
  const auto time = static_cast<std::size_t>(
      std::find(history.columns.begin(), history.columns.end(), "time") - history.columns.begin());
  Curve curve{record.name, false, {Vec2::Zero()}};
  for (std::size_t i = 0; i < record.forces.size(); ++i)
    curve.values.emplace_back(history.rows[i].at(time), record.forces[i].norm());
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

} // namespace

Chart load_stroke(const std::filesystem::path& results) {
  const std::filesystem::path file = results / "history.csv";
  if (!std::filesystem::exists(file))
    throw Error(Fault::input_output, results.string(), "the folder has no history.csv",
                "give the folder a run wrote its results to");
  const Table history = read_table(file);
  const std::vector<Record> records = records_of(history);
  Chart chart;
  for (const Record& record : records)
    if (!record.direction.isZero(0.0))
      chart.curves.push_back(over_stroke(record));
  const bool travels = !chart.curves.empty();
  if (!travels)
    for (const Record& record : records)
      chart.curves.push_back(over_time(record, history));
  if (chart.curves.empty() || history.rows.empty())
    throw Error(Fault::input_output, file.string(), "the table has no forces of tools");
  chart.title = text_of(results / "case.resolved.toml", "title");
  const CaseUnits units = units_of(results);
  chart.x_label = travels ? fmt::format("stroke [{}]", rescale(chart.curves, 0, units.length))
                          : fmt::format("time [{}]", units.time);
  const std::string force = rescale(chart.curves, 1, units.force);
  chart.y_label = units.per_thickness
                      ? fmt::format("force per thickness [{}/{}]", force, units.length)
                      : fmt::format("force [{}]", force);
  return chart;
}

} // namespace billet::render
