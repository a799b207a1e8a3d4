#include "study/chart.h"

#include "geometry/base/error.h"
#include "io/case/toml_text.h"
#include "io/results/atomic_file.h"
#include "io/results/folder_lock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "study/extrapolation.h"

namespace billet::study {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// What one row of the chart is run for.
struct ChartRow {
  std::size_t law = 0;
  std::size_t point = 0;                     ///< of the parameters' grid
  std::size_t refinement = 0;                ///< 0 too where there is none
  std::optional<std::size_t> uncertain = {}; ///< that is changed by its standard uncertainty
  Row row = {};
};

std::size_t n_points(const Law& law) {
  std::size_t n = 1;
  for (const Parameter& parameter : law.parameters)
    n *= parameter.values.size();
  return n;
}

/// Values of the parameters at a point of their grid, the last one changing fastest.
std::vector<double> at_point(const std::vector<Parameter>& parameters, std::size_t point) {
  std::vector<double> values(parameters.size());
  for (std::size_t p = parameters.size(); p-- > 0;) {
    values[p] = parameters[p].values[point % parameters[p].values.size()];
    point /= parameters[p].values.size();
  }
  return values;
}

ChartRow row_of(const ChartFile& file,
                std::size_t law,
                std::size_t point,
                std::size_t refinement,
                std::optional<std::size_t> uncertain) {
  ChartRow row{law, point, refinement, uncertain};
  const auto add = [&](const std::string& label, const std::vector<Assignment>& set) {
    row.row.labels.push_back(label);
    row.row.assignments.insert(row.row.assignments.end(), set.begin(), set.end());
  };
  const Law& of = file.laws[law];
  add(of.name, of.set);
  const std::vector<double> values = at_point(of.parameters, point);
  for (std::size_t p = 0; p < values.size(); ++p) {
    std::vector<Assignment> set;
    for (const std::string& key : of.parameters[p].keys)
      set.push_back({key, io::toml_text(values[p])});
    add(fmt::format("{} {:.6g}", of.parameters[p].name, values[p]), set);
  }
  if (!file.refinement.empty())
    add(file.refinement[refinement].label, file.refinement[refinement].set);
  for (std::size_t u = 0; u < file.uncertain.size(); ++u) {
    const Uncertain& which = file.uncertain[u];
    const bool changed = uncertain == u;
    const Assignment set{which.key, io::toml_text(which.value + (changed ? which.standard : 0.0))};
    row.row.assignments.push_back(set);
    if (changed)
      row.row.labels.push_back(which.name);
  }
  return row;
}

/// The finest level, all others, and on the finest one what is uncertain changed.
std::vector<ChartRow> rows_of_chart(const ChartFile& file) {
  std::vector<ChartRow> rows;
  const std::size_t n_levels = std::max<std::size_t>(1, file.refinement.size());
  for (std::size_t law = 0; law < file.laws.size(); ++law)
    for (std::size_t point = 0; point < n_points(file.laws[law]); ++point) {
      for (std::size_t level = n_levels; level-- > 0;)
        rows.push_back(row_of(file, law, point, level, std::nullopt));
      for (std::size_t u = 0; u < file.uncertain.size(); ++u)
        rows.push_back(row_of(file, law, point, n_levels - 1, u));
    }
  return rows;
}

/// Values of a quantity at the stations; not a number where the run did not get there.
std::vector<double> curve_of(const ChartFile& file, const PlannedRun& run, const Reading& y) {
  std::vector<double> values(file.stations.size(), not_there);
  const std::filesystem::path results = run.folder / "results";
  // A run that ended early is good as far as it got; the results of a failed check are not.
  const std::optional<EndedRun> end = ended(run);
  const bool failed_check = end && end->status == static_cast<int>(Fault::failed_check);
  if (!run.refused.empty() || failed_check || !std::filesystem::exists(results / "summary.json"))
    return values;
  const Results read(results);
  const std::vector<double> xs = read.values(file.x.of), ys = read.values(y.of);
  const double onwards = !xs.empty() && xs.back() < xs.front() ? -1.0 : 1.0;
  for (std::size_t s = 0; s < values.size(); ++s) {
    const double at = file.stations[s], half = 0.5 * y.average;
    if (!(y.average > 0.0))
      values[s] = curve_at(xs, ys, at).value_or(not_there);
    else if (curve_at(xs, ys, at + onwards * half)) // the run goes through the window
      values[s] = mean_between(xs, ys, at - half, at + half);
  }
  return values;
}

/// Half width of 95 % of what is left at the finest of some levels, from coarse to fine.
double error_left(const ChartFile& file, const std::vector<double>& values) {
  std::vector<double> sizes, known;
  for (std::size_t level = 0; level < values.size(); ++level)
    if (std::isfinite(values[level])) {
      sizes.push_back(*file.refinement[level].size);
      known.push_back(values[level]);
    }
  if (known.size() < 2 || !std::isfinite(values.back()))
    return not_there;
  if (known.size() > 2)
    return extrapolate(sizes, known).uncertainty.back();
  // Of the first order, with the safety that three levels in the asymptotic range have.
  constexpr double safety = 1.25;
  return safety * std::abs(known[1] - known[0]) / (sizes[0] / sizes[1] - 1.0);
}

/// Curves by row of the chart.
class Curves {
public:
  Curves(const ChartFile& file,
         const std::vector<ChartRow>& rows,
         const std::vector<PlannedRun>& runs)
      : file_(file), rows_(rows) {
    for (const PlannedRun& run : runs) {
      values_.emplace_back();
      for (const Reading& y : file.y)
        values_.back().push_back(curve_of(file, run, y));
    }
  }

  [[nodiscard]] const std::vector<double>& at(std::size_t law,
                                              std::size_t point,
                                              std::size_t refinement,
                                              std::optional<std::size_t> uncertain,
                                              std::size_t quantity) const {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].law == law && rows_[r].point == point && rows_[r].refinement == refinement &&
          rows_[r].uncertain == uncertain)
        return values_[r][quantity];
    throw std::logic_error("a chart without one of its rows");
  }

  [[nodiscard]] ChartedQuantity quantity(std::size_t law, std::size_t which) const {
    ChartedQuantity charted{file_.y[which].name, {}, {}, {}};
    const std::size_t n_levels = std::max<std::size_t>(1, file_.refinement.size());
    charted.change.resize(file_.uncertain.size());
    for (std::size_t point = 0; point < n_points(file_.laws[law]); ++point) {
      charted.values.push_back(at(law, point, n_levels - 1, std::nullopt, which));
      const std::vector<double>& finest = charted.values.back();
      std::vector<double>& error = charted.model_error.emplace_back(file_.stations.size(), 0.0);
      for (std::size_t s = 0; s < error.size() && n_levels > 1; ++s) {
        std::vector<double> levels;
        for (std::size_t level = 0; level < n_levels; ++level)
          levels.push_back(at(law, point, level, std::nullopt, which)[s]);
        error[s] = error_left(file_, levels);
      }
      for (std::size_t u = 0; u < file_.uncertain.size(); ++u) {
        std::vector<double> change = at(law, point, n_levels - 1, u, which);
        for (std::size_t s = 0; s < change.size(); ++s)
          change[s] -= finest[s];
        charted.change[u].push_back(std::move(change));
      }
    }
    return charted;
  }

private:
  const ChartFile& file_;
  const std::vector<ChartRow>& rows_;
  std::vector<std::vector<std::vector<double>>> values_; ///< shape (rows, quantities, stations)
};

} // namespace

std::optional<Chart> conduct_chart(const ChartFile& file, const Conduct& how) {
  io::make_folder(how.folder);
  const io::FolderLock lock(how.folder);
  const std::vector<ChartRow> chart_rows = rows_of_chart(file);
  std::vector<Row> rows(chart_rows.size());
  std::transform(chart_rows.begin(), chart_rows.end(), rows.begin(),
                 [](const ChartRow& row) { return row.row; });
  std::vector<std::string> read_off{file.x.of};
  for (const auto& y : file.y)
    read_off.push_back(y.of);
  const std::vector<PlannedRun> runs = make_runs_of(file.study, rows, read_off, how);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::optional<EndedRun> end = ended(runs[r]);
    if (!end)
      return std::nullopt;
    if (end->status != 0)
      how.say(fmt::format("warning: [run-failed] {}: status {}, {}",
                          fmt::join(rows[r].labels, ", "), end->status, end->reason));
  }
  Chart chart{file.study.title, file.x.name, file.stations, {}, {}};
  for (const Uncertain& uncertain : file.uncertain)
    chart.uncertain.push_back(uncertain.name);
  const Curves curves(file, chart_rows, runs);
  for (std::size_t law = 0; law < file.laws.size(); ++law) {
    ChartedLaw& charted = chart.laws.emplace_back();
    charted.name = file.laws[law].name;
    charted.parameters = file.laws[law].parameters;
    for (std::size_t q = 0; q < file.y.size(); ++q)
      charted.quantities.push_back(curves.quantity(law, q));
  }
  write_chart(chart, how.folder);
  return chart;
}

} // namespace billet::study
