#include "io/text/csv_table.h"

#include "geometry/base/error.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

namespace billet::io {

namespace {

/// Cells of a line; a quote within quotes is written twice.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false, was_quoted = false;
  const auto end_cell = [&] {
    if (!was_quoted)
      cells.back() = std::string(trimmed(cells.back()));
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"' && (quoted || trimmed(cells.back()).empty())) {
      cells.back() = quoted ? cells.back() : "";
      quoted = !quoted;
      was_quoted = true;
    } else if (c == ',' && !quoted) {
      end_cell();
      cells.emplace_back();
    } else if (!was_quoted || quoted) {
      cells.back() += c;
    }
  }
  end_cell();
  return cells;
}

double number_in(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end != cell.c_str() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found != columns.end() ? std::optional(static_cast<std::size_t>(found - columns.begin()))
                                : std::nullopt;
}

std::vector<double> CsvTable::numbers(std::size_t column) const {
  std::vector<double> values;
  for (const std::vector<std::string>& row : rows)
    values.push_back(number_in(row[column]));
  return values;
}

CsvTable read_csv(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(Fault::input_output, file.string(),
                fmt::format("the table cannot be read: {}", std::strerror(errno)));
  CsvTable table;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number == 1 && line.starts_with(byte_order_mark))
      line.erase(0, byte_order_mark.size());
    if (trimmed(line).empty() || line.starts_with('#'))
      continue;
    std::vector<std::string> cells = cells_of(line);
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() > table.columns.size())
      throw Error(Fault::input_output, fmt::format("{}:{}", file.string(), number),
                  fmt::format("the line has {} cells, the table has {} columns", cells.size(),
                              table.columns.size()),
                  "text with commas goes in double quotes, decimals take a point");
    cells.resize(table.columns.size());
    table.rows.push_back(std::move(cells));
  }
  if (table.columns.empty())
    throw Error(Fault::input_output, file.string(), "the table is empty",
                "its first line names the columns");
  return table;
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\n#") == std::string_view::npos)
    return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    cell += c == '\n' ? ' ' : c;
    if (c == '"')
      cell += '"';
  }
  return cell + '"';
}

} // namespace billet::io
