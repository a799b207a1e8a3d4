// What `billet watch` says of a run.

#pragma once

#include "app/progress_bar.h"
#include "app/report/results_folder.h"

#include <optional>
#include <span>
#include <string>

namespace billet::app {

/// Several lines: status, progress, the last increment, forces with their curves, warnings.
[[nodiscard]] std::string watch_text(const report::ResultsFolder& results, int columns);

/// One line.
[[nodiscard]] std::string watch_line(const report::ResultsFolder& results);

/// A curve of block characters from zero to the largest value, of the values' magnitudes.
[[nodiscard]] std::string text_curve(std::span<const double> values, std::size_t width);

/// How long the run takes still, at the pace of its later half; none: nobody can tell. [s]
[[nodiscard]] std::optional<double> time_left(const report::ResultsFolder& results);

} // namespace billet::app
