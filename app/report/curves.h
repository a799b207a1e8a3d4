// The curves of a report, from the tables of a run.

#pragma once

#include "app/render/curve.h"
#include "app/report/results_folder.h"

#include <string>
#include <vector>

namespace billet::report {

/// A chart and where it stands.
struct NamedChart {
  std::string id; ///< of the element in the page
  render::Chart chart;
  bool logarithmic = false; ///< ordinate
  bool over_time = false;   ///< abscissa is the time of the process
};

/// Loads over strokes or time, energies, convergence, penetration, measures: those for which there
/// are rows.
[[nodiscard]] std::vector<NamedChart> curves_of(const ResultsFolder& results);

/// As many points at most, with the least and the largest value of each stretch among them.
[[nodiscard]] std::vector<Vec2> thinned(const std::vector<Vec2>& values, std::size_t most);

} // namespace billet::report
