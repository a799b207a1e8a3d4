#include "app/render/curve.h"

#include "geometry/base/error.h"
#include "io/text/csv_table.h"

#include <fmt/format.h>

#include <cstddef>

namespace billet::render {

namespace {

/// A column of a table and the sign it is drawn with.
struct Column {
  std::size_t position;
  double sign;
};

Column find_column(const io::CsvTable& table,
                   const std::string& asked,
                   const std::filesystem::path& file) {
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0.0 && !asked.starts_with('-'))
      break;
    if (const auto found = table.find(sign > 0.0 ? asked : asked.substr(1)))
      return {*found, sign};
  }
  throw Error(Fault::usage, file.string(), fmt::format("the table has no column \"{}\"", asked),
              fmt::format("it has {}", fmt::join(table.columns, ", ")));
}

} // namespace

Curve read_curve(const Series& series) {
  const io::CsvTable table = io::read_csv(series.file);
  const Column x = find_column(table, series.x_column, series.file);
  const Column y = find_column(table, series.y_column, series.file);
  Curve curve{series.label, series.points, {}};
  const std::vector<double> xs = table.numbers(x.position), ys = table.numbers(y.position);
  for (std::size_t i = 0; i < xs.size(); ++i)
    if (const Vec2 value(x.sign * xs[i], y.sign * ys[i]); value.allFinite())
      curve.values.push_back(value);
  if (curve.values.empty())
    throw Error(Fault::input_output, series.file.string(), "the table has no rows of numbers");
  return curve;
}

} // namespace billet::render
