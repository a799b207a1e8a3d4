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
  bool tight = false; ///< axes need not hold zero
};

/// The points of a series; rows that lack a number are left out.
/// @throws Error  also for a column that is not there, or without numbers
[[nodiscard]] Curve read_curve(const Series& series);

} // namespace billet::render
