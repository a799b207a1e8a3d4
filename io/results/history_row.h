// A row of history.csv: what is written down of an increment.
//
// Columns and units: docs/guide/results.md, "history.csv".

#pragma once

#include "process/reports/run_reports.h"
#include "process/state/run.h"

#include <string>
#include <vector>

namespace billet::io {

/// Names of the columns: the fixed ones, those of each tool, those of measures.
[[nodiscard]] std::vector<std::string> history_columns(const process::Scene& scene);

/// The row of an increment, as long as there are columns.
///
/// @param run  at the end of that increment, before a new mesh is made
[[nodiscard]] std::vector<double> history_row(const process::Run& run,
                                              const process::IncrementReport& report);

} // namespace billet::io
