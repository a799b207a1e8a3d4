// Curves of a chart, from columns of tables.

#pragma once

#include "app/render/options.h"
#include "geometry/base/vector.h"

#include <filesystem>
#include <string>
#include <vector>

namespace billet::render {

struct Curve {
  std::string label;
  bool points = false; ///< markers without a line
  std::vector<Vec2> values;
};

/// Curves and what their axes measure.
struct Chart {
  std::vector<Curve> curves;
  std::string title, x_label, y_label;
};

/// A .csv file: comments, which begin with #, are left out.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows; ///< not a number where a cell holds none
};

/// @throws Error  for a file that cannot be read
[[nodiscard]] Table read_table(const std::filesystem::path& file);

/// The points of a series; rows that lack a number are left out.
/// @throws Error  also for a column that is not there, or without numbers
[[nodiscard]] Curve read_curve(const Series& series);

} // namespace billet::render
