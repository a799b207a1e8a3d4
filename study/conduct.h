// Makes the runs of a study that have not been made, and writes down what they gave.
//
// FOLDER/runs/<identity>/ of each run, FOLDER/study.csv, FOLDER/study.json, FOLDER/study.md.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/study_json.h"

namespace billet::study {

/// How a study is made.
struct Conduct {
  Program program;
  std::filesystem::path folder;                ///< of the study's results
  bool again = false;                          ///< runs that failed are made again
  std::function<bool()> stopped;               ///< once true no more runs are started
  std::function<void(const std::string&)> say; ///< a line on how it goes
};

/// Makes the runs of rows that have not been made, in FOLDER/runs.
/// @param read_off  expressions of columns of history.csv and numbers of summary.json
/// @return of every row its run, which may be left to be made
/// @throws Error (Fault::case_file) before any run, for a column that no run will have
[[nodiscard]] std::vector<PlannedRun> make_runs_of(const Study& study,
                                                   const std::vector<Row>& rows,
                                                   const std::vector<std::string>& read_off,
                                                   const Conduct& how);

struct Conducted {
  std::vector<OutcomeRow> rows;
  Findings findings;
  std::size_t n_left = 0; ///< rows whose run has not been made
};

/// @throws Error, also if another study writes into the folder
[[nodiscard]] Conducted conduct(const Study& study, const Conduct& how);

} // namespace billet::study
