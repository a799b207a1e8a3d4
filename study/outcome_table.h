// What the runs of a study gave: one row per run.

#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/plan.h"
#include "study/runs.h"

namespace billet::study {

/// What a run took.
struct RunCost {
  double processor_time = 0.0; ///< [s]
  double iterations = 0.0;     ///< those of failed tries and of new meshes included
  double memory = 0.0;         ///< largest resident [byte]
};

/// A row, its run and what was read off it.
struct OutcomeRow {
  Row row;
  std::string folder;          ///< of the run; empty: it could not be run
  std::optional<EndedRun> end; ///< none: it has not been run
  /// Of the quantities; not a number: it cannot be read off. Empty: the run did not reach its end.
  std::vector<double> values;
  RunCost cost;
  bool complete = false; ///< the run reached its end and all quantities were read off

  [[nodiscard]] bool good() const { return complete; }
};

/// Reads quantities and costs of a run that has ended. A quantity that cannot be read off is the
/// row's reason.
[[nodiscard]] OutcomeRow outcome_of(const Study& study, const Row& row, const PlannedRun& run);

/// Columns of study.csv in addition to those of axes and quantities.
inline constexpr std::array<std::string_view, 8> columns_of_every_study{
    "row", "status", "reason", "processor_time", "iterations", "memory_mb", "error", "folder"};

/// study.csv: rows, what was varied, how the run ended, quantities, costs, and further columns.
struct FurtherColumn {
  std::string name;
  std::vector<double> values; ///< shape (n_rows); not a number: an empty cell
};
[[nodiscard]] std::string csv_text(const Study& study,
                                   const std::vector<OutcomeRow>& rows,
                                   const std::vector<FurtherColumn>& further);

} // namespace billet::study
