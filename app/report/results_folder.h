// What a folder of results says: of a run that has ended, is going on, was killed or failed.
//
// Everything is optional: a run that has just begun has no history, one that goes on no summary.
// A file that cannot be read is left out and named in `unreadable`.

#pragma once

#include "app/report/case_facts.h"
#include "io/results/folder_lock.h"
#include "io/text/csv_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace billet::report {

enum class RunState { running, killed, ended };

struct ResultsFolder {
  std::filesystem::path path;
  std::string name;  ///< of the case
  std::string title; ///< of the case; its name where it has none
  RunState state = RunState::killed;
  std::optional<io::WritingRun> writer; ///< where the run goes on
  nlohmann::ordered_json summary;       ///< an object, without a key as long as there is none
  nlohmann::ordered_json starts;        ///< an array: how the run was started, and resumed
  std::string case_text;                ///< case.resolved.toml
  CaseFacts facts;                      ///< of the case
  std::vector<std::string> log;         ///< lines of run.log
  std::string post_mortem;              ///< failure/post_mortem.txt
  io::CsvTable history, iterations, remeshings; ///< without columns where there is none
  std::vector<std::string> unreadable;          ///< what could not be read, in words

  [[nodiscard]] const io::UnitSystem& units() const { return facts.units; }
  /// Unit of a quantity of the whole part, such as a force: in plane strain it is per thickness.
  [[nodiscard]] std::string of_whole(const std::string& unit) const {
    return facts.analysis == io::Analysis::plane_strain ? unit + "/" + units().length : unit;
  }
  /// "running", "killed", or the status of the summary.
  [[nodiscard]] std::string status() const;
  /// Exit status of the run; none: it has not ended.
  [[nodiscard]] std::optional<int> exit_status() const;
  /// Lines of the log that begin so, without that beginning.
  [[nodiscard]] std::vector<std::string> said(std::string_view beginning) const;
  /// Names of the tools, as the history has them.
  [[nodiscard]] std::vector<std::string> tools() const;
};

/// @throws Error  (Fault::input_output) if it is no folder of results
[[nodiscard]] ResultsFolder read_results(const std::filesystem::path& folder);

/// A column of a table; empty: it is not there.
[[nodiscard]] std::vector<double> column(const io::CsvTable& table, std::string_view name);

} // namespace billet::report
