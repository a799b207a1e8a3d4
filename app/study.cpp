// billet study: runs a case with a matrix of settings and says what they make of it.

#include "app/command_line.h"
#include "app/render.h"
#include "app/stop_signals.h"
#include "geometry/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "study/conduct.h"
#include "study/pictures.h"

namespace billet::app {

study::Conduct conduct_of(const Arguments& arguments, const std::filesystem::path& folder) {
  return {.program = {own_file(), BILLET_VERSION},
          .folder = folder,
          .again = arguments.again,
          .stopped = [] { return stop_signal() != 0; },
          .say =
              [quiet = arguments.quiet](const std::string& line) {
                if (!quiet || line.starts_with("warning"))
                  fmt::print(stderr, "{}\n", line);
              }};
}

namespace {

/// The status of a study whose runs have not all been made: a queue has them, or one was killed.
constexpr int rows_are_left = 1;

/// Why rows failed, each reason once, with the number of its rows: never silent.
void print_reasons(const std::vector<study::OutcomeRow>& rows) {
  std::map<std::string, int> reasons;
  for (const study::OutcomeRow& row : rows)
    if (row.end && !row.good())
      ++reasons[row.end->reason];
  constexpr std::size_t most = 10;
  std::size_t told = 0;
  for (const auto& [reason, count] : reasons)
    if (told++ < most)
      fmt::print(stderr, "failed, {} row(s): {}\n", count, reason);
  if (told > most)
    fmt::print(stderr, "and {} other reasons: study.csv\n", told - most);
}

} // namespace

int conduct_study(const Arguments& arguments) {
  study::Study study = study::read_study(arguments.file, arguments.overrides);
  if (arguments.processes)
    study.engine.processes = arguments.processes;
  if (arguments.threads)
    study.engine.threads = *arguments.threads;
  const std::filesystem::path folder = arguments.output.value_or(
      std::filesystem::path("results") / file_name(arguments.file, "study"));
  notice_stop_signals();
  const study::Conduct how = conduct_of(arguments, folder);
  const study::Conducted result = study::conduct(study, how);
  const auto n_failed =
      std::count_if(result.rows.begin(), result.rows.end(),
                    [](const study::OutcomeRow& row) { return row.end && !row.good(); });
  fmt::print("{}", study::in_words(study, result.findings));
  print_reasons(result.rows);
  fmt::print("{} row(s), {} of them failed{}\n", result.rows.size(), n_failed,
             result.n_left > 0 ? fmt::format(", {} are left to be run", result.n_left) : "");
  if (result.n_left == 0)
    for (const study::Picture& picture : study::pictures_of(study, result, folder))
      draw_curves(picture.arguments, how.say);
  fmt::print("results: {}\n", folder.string());
  return stop_signal() != 0 ? 128 + stop_signal() : result.n_left > 0 ? rows_are_left : 0;
}

} // namespace billet::app
