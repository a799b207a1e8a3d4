#include "app/render/curve.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

namespace billet::render {

SignedColumn find_column(const io::CsvTable& table,
                         const std::string& asked,
                         const std::filesystem::path& file) {
  const std::string without_sign = asked.starts_with('-') ? asked.substr(1) : asked;
  if (const auto found = table.find(asked))
    return {*found, 1.0};
  if (const auto found = table.find(without_sign))
    return {*found, -1.0};
  std::string remedy = io::suggestion(without_sign, table.columns);
  const std::string list = fmt::format("it has {}", fmt::join(table.columns, ", "));
  remedy = remedy.starts_with("did you mean") ? remedy + " " + list : list;
  throw Error(Fault::usage, file.string(), fmt::format("the table has no column \"{}\"", asked),
              remedy);
}

std::vector<Vec2> points_of(const io::CsvTable& table,
                            const SignedColumn& x,
                            const SignedColumn& y,
                            const std::filesystem::path& file) {
  const std::vector<double> xs = table.numbers(x.position), ys = table.numbers(y.position);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < xs.size(); ++i)
    if (const Vec2 point(x.sign * xs[i], y.sign * ys[i]); point.allFinite())
      points.push_back(point);
  if (points.empty())
    throw Error(Fault::input_output, file.string(), "the table has no rows of numbers");
  return points;
}

Curve read_curve(const Series& series) {
  const io::CsvTable table = io::read_csv(series.file);
  const SignedColumn x = find_column(table, series.x_column, series.file);
  const SignedColumn y = find_column(table, series.y_column, series.file);
  return {series.label, series.points, points_of(table, x, y, series.file)};
}

} // namespace billet::render
