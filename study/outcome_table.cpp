#include "study/outcome_table.h"

#include "geometry/base/error.h"
#include "io/text/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace billet::study {

namespace {

RunCost cost_of(const Results& results) {
  const auto number = [&](const char* path) { return results.summary(path).value_or(0.0); };
  return {.processor_time = number("resources.processor_seconds"),
          .iterations = number("iterations") + number("iterations_of_failed_tries") +
                        number("iterations_on_new_meshes"),
          .memory = number("resources.peak_memory_bytes")};
}

/// The quantity, or not a number and the reason.
double value_of(const Quantity& quantity,
                const Results& results,
                const std::map<std::string, double>& before,
                std::string& reason) {
  try {
    const double value = evaluate(quantity, results, before);
    if (!std::isfinite(value) && reason.empty())
      reason = fmt::format("quantity '{}' is not a finite number", quantity.name);
    return std::isfinite(value) ? value : std::nan("");
  } catch (const Error& error) {
    if (reason.empty())
      reason = error.what();
    return std::nan("");
  }
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.10g}", value) : ""; }

} // namespace

OutcomeRow outcome_of(const Study& study, const Row& row, const PlannedRun& run) {
  OutcomeRow outcome{row, run.folder.string(), ended(run), {}, {}, false};
  if (!outcome.end || !run.refused.empty())
    return outcome;
  try {
    const Results results(run.folder / "results");
    outcome.cost = cost_of(results);
    if (outcome.end->status != 0)
      return outcome;
    std::map<std::string, double> before;
    for (const Quantity& quantity : study.quantities) {
      outcome.values.push_back(value_of(quantity, results, before, outcome.end->reason));
      before[quantity.name] = outcome.values.back();
    }
    outcome.complete = std::all_of(outcome.values.begin(), outcome.values.end(),
                                   [](double value) { return std::isfinite(value); });
  } catch (const Error& error) {
    if (outcome.end->reason.empty())
      outcome.end->reason = error.what();
  }
  return outcome;
}

std::string csv_text(const Study& study,
                     const std::vector<OutcomeRow>& rows,
                     const std::vector<FurtherColumn>& further) {
  std::vector<std::string> header{"row"};
  for (const Axis& axis : study.axes)
    header.push_back(axis.name);
  for (const char* name : {"status", "reason"})
    header.emplace_back(name);
  for (const Quantity& quantity : study.quantities)
    header.push_back(quantity.name);
  for (const char* name : {"processor_time", "iterations", "memory_mb"})
    header.emplace_back(name);
  for (const FurtherColumn& column : further)
    header.push_back(column.name);
  header.emplace_back("folder");
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    std::vector<std::string> safe(cells.size());
    std::transform(cells.begin(), cells.end(), safe.begin(), &io::csv_cell);
    text += fmt::format("{}\n", fmt::join(safe, ","));
  };
  add(header);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const OutcomeRow& row = rows[r];
    std::vector<std::string> cells{std::to_string(r + 1)};
    cells.insert(cells.end(), row.row.labels.begin(), row.row.labels.end());
    cells.push_back(row.end ? std::to_string(row.end->status) : "");
    cells.push_back(row.end ? row.end->reason : "not run");
    for (std::size_t q = 0; q < study.quantities.size(); ++q)
      cells.push_back(q < row.values.size() ? cell(row.values[q]) : "");
    constexpr double mega = 1e6;
    const bool ran = row.cost.processor_time > 0.0;
    for (const double value :
         {row.cost.processor_time, row.cost.iterations, row.cost.memory / mega})
      cells.push_back(ran ? cell(value) : "");
    for (const FurtherColumn& column : further)
      cells.push_back(cell(column.values[r]));
    cells.push_back(row.folder);
    add(cells);
  }
  return text;
}

} // namespace billet::study
