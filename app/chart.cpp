// billet chart and billet identify: friction tests, and coefficients from what was measured.

#include "app/command_line.h"
#include "app/render.h"
#include "app/stop_signals.h"
#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "study/identify.h"

namespace billet::app {

namespace {

/// Stations that no run of a law reaches have no curve: never silent.
void warn_of_empty(const study::Chart& chart) {
  for (const study::ChartedLaw& law : chart.laws)
    for (const study::ChartedQuantity& quantity : law.quantities) {
      std::vector<std::string> empty;
      for (std::size_t s = 0; s < chart.stations.size(); ++s)
        if (std::none_of(quantity.values.begin(), quantity.values.end(),
                         [&](const auto& curve) { return std::isfinite(curve[s]); }))
          empty.push_back(fmt::format("{:.6g}", chart.stations[s]));
      if (!empty.empty())
        fmt::print(stderr, "warning: [chart-empty] law '{}': no run gives {} at {} = {}\n",
                   law.name, quantity.name, chart.x, fmt::join(empty, ", "));
    }
}

} // namespace

int make_chart(const Arguments& arguments) {
  study::ChartFile file = study::read_chart_file(arguments.file, arguments.overrides);
  if (arguments.processes)
    file.study.engine.processes = arguments.processes;
  if (arguments.threads)
    file.study.engine.threads = *arguments.threads;
  const std::filesystem::path folder = arguments.output.value_or(
      std::filesystem::path("results") / file_name(arguments.file, "chart"));
  notice_stop_signals();
  const study::Conduct how = conduct_of(arguments, folder);
  const std::optional<study::Chart> chart = study::conduct_chart(file, how);
  if (!chart)
    fmt::print("the chart has runs left to be made\n");
  else
    warn_of_empty(*chart);
  if (chart)
    for (const std::vector<std::string>& words : study::chart_pictures(*chart, folder))
      draw_curves(words, how.say);
  fmt::print("results: {}\n", folder.string());
  constexpr int runs_are_left = 1;
  return stop_signal() != 0 ? 128 + stop_signal() : chart ? 0 : runs_are_left;
}

int identify_parameters(const Arguments& arguments) {
  if (arguments.rest.empty())
    throw Error(Fault::usage, "", "billet identify: the measurements are missing",
                "billet identify CHART MEASUREMENTS.csv");
  const std::filesystem::path given = arguments.file;
  const study::Chart chart =
      study::read_chart(std::filesystem::is_directory(given) ? given / "chart.json" : given);
  const study::Identification found =
      study::identify(chart, study::read_measurements(arguments.rest.front(), chart));
  fmt::print("{}", study::in_words(found));
  if (arguments.output) {
    io::make_folder(*arguments.output);
    io::write_file(*arguments.output / "identification.json", study::json_text(found));
    fmt::print("results: {}\n", arguments.output->string());
  }
  return 0;
}

} // namespace billet::app
