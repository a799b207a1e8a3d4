// Where the runs of a study lie, and which of them are done.
//
// RUNS/<identity>/ is the folder of one run: results/, output.txt, and exit_status once it has
// ended. The identity is a checksum of the program's version, of the case with every default filled
// in and of the files that it names: what has been run is known again whatever the study looks like
// by then.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/plan.h"

namespace billet::study {

/// The program that makes the runs.
struct Program {
  std::filesystem::path file;
  std::string version;
};

/// One row's run.
struct PlannedRun {
  std::string identity = {};
  std::filesystem::path folder = {};
  std::vector<std::string> command = {}; ///< program and its arguments; empty: it cannot be run
  std::string refused = {};              ///< why not; else empty
  std::vector<std::string> columns = {}; ///< that its history.csv will have
};

/// How a run that has ended, ended.
struct EndedRun {
  int status = 0;     ///< of the program
  std::string reason; ///< empty: it came to its end
};

/// Reads the case with the row's settings: what is wrong with it makes `refused`.
[[nodiscard]] PlannedRun plan_run(const Study& study,
                                  const Row& row,
                                  const std::filesystem::path& runs,
                                  const Program& program);

/// None: it has not been run to an end, or was stopped by a signal.
[[nodiscard]] std::optional<EndedRun> ended(const PlannedRun& run);

/// The command as it goes on where it was stopped.
[[nodiscard]] std::vector<std::string> command_of(const PlannedRun& run);

/// A word in quotes for a shell.
[[nodiscard]] std::string quoted(const std::string& word);

/// As a line for a shell, which notes the status when it has ended.
[[nodiscard]] std::string shell_line(const PlannedRun& run);

} // namespace billet::study
