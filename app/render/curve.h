// Curves of a chart, from columns of tables.

#pragma once

#include "app/render/options.h"
#include "geometry/base/vector.h"
#include "io/text/csv_table.h"

#include <array>
#include <cstddef>
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
  bool tight = false;                ///< axes need not hold zero
  std::array<bool, 2> logarithmic{}; ///< x, y
};

/// The points of a series; rows that lack a number are left out.
/// @throws Error  also for a column that is not there, or without numbers
[[nodiscard]] Curve read_curve(const Series& series);

/// A column of a table and the sign it is drawn with.
struct SignedColumn {
  std::size_t position = 0;
  double sign = 1.0;
};

/// @param asked  its name; a minus before it turns the sign
/// @throws Error  (Fault::usage) for a column that is not there, with those that are
[[nodiscard]] SignedColumn
find_column(const io::CsvTable& table, const std::string& asked, const std::filesystem::path& file);

/// The points of two columns; rows that lack a number are left out.
/// @throws Error  (Fault::input_output) where no row has both
[[nodiscard]] std::vector<Vec2> points_of(const io::CsvTable& table,
                                          const SignedColumn& x,
                                          const SignedColumn& y,
                                          const std::filesystem::path& file);

} // namespace billet::render
