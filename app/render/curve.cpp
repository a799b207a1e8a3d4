#include "app/render/curve.h"

#include "geometry/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace billet::render {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r\"");
    const auto last = cell.find_last_not_of(" \t\r\"");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

double number_in(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end != cell.c_str() ? value : std::numeric_limits<double>::quiet_NaN();
}

/// A column of a table and the sign it is drawn with.
struct Column {
  std::size_t position;
  double sign;
};

Column
find_column(const Table& table, const std::string& asked, const std::filesystem::path& file) {
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0.0 && !asked.starts_with('-'))
      break;
    const auto found =
        std::find(table.columns.begin(), table.columns.end(), sign > 0.0 ? asked : asked.substr(1));
    if (found != table.columns.end())
      return {static_cast<std::size_t>(found - table.columns.begin()), sign};
  }
  throw Error(Fault::usage, file.string(), fmt::format("the table has no column \"{}\"", asked),
              fmt::format("it has {}", fmt::join(table.columns, ", ")));
}

} // namespace

Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(Fault::input_output, file.string(),
                fmt::format("the table cannot be read: {}", std::strerror(errno)));
  Table table;
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty() || line.starts_with('#'))
      continue;
    if (table.columns.empty()) {
      table.columns = cells;
      continue;
    }
    std::vector<double>& row = table.rows.emplace_back();
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      row.push_back(i < cells.size() ? number_in(cells[i])
                                     : std::numeric_limits<double>::quiet_NaN());
  }
  return table;
}

Curve read_curve(const Series& series) {
  const Table table = read_table(series.file);
  const Column x = find_column(table, series.x_column, series.file);
  const Column y = find_column(table, series.y_column, series.file);
  Curve curve{series.label, series.points, {}};
  for (const std::vector<double>& row : table.rows) {
    const Vec2 value(x.sign * row[x.position], y.sign * row[y.position]);
    if (value.allFinite())
      curve.values.push_back(value);
  }
  if (curve.values.empty())
    throw Error(Fault::input_output, series.file.string(), "the table has no rows of numbers");
  return curve;
}

} // namespace billet::render
