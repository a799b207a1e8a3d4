#include "study/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "study/sampling.h"

namespace billet::study {

namespace {

void add(Row& row, const Level& level) {
  row.labels.push_back(level.label);
  row.assignments.insert(row.assignments.end(), level.set.begin(), level.set.end());
  if (level.case_file)
    row.case_file = level.case_file;
}

/// The level of an axis at a place between its ends.
Level drawn(const Axis& axis, double share) {
  if (!axis.range) {
    const auto n = static_cast<double>(axis.levels.size());
    return axis.levels[static_cast<std::size_t>(share * n)];
  }
  const Range& range = *axis.range;
  const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, share)
                                         : range.low + share * (range.high - range.low);
  const std::string text = fmt::format("{:.10g}", value);
  return {text, {{range.key, text}}};
}

std::vector<Row> sampled(const Study& study) {
  const auto dimensions = static_cast<int>(study.axes.size());
  const Sample& sample = *study.sample;
  const auto points = sample.method == Sample::Method::sobol
                          ? sobol(sample.count, dimensions, sample.seed)
                          : latin_hypercube(sample.count, dimensions, sample.seed);
  std::vector<Row> rows(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      add(rows[i], drawn(study.axes[a], points[i][a]));
  return rows;
}

} // namespace

std::vector<std::string> Row::overrides() const {
  std::vector<std::string> words;
  for (const Assignment& assignment : assignments)
    words.push_back(assignment.key + "=" + assignment.value);
  return words;
}

std::vector<Row> rows_of(const Study& study) {
  if (study.sample && !study.axes.empty())
    return sampled(study);
  std::vector<Row> rows(1);
  for (const Axis& axis : study.axes) {
    std::vector<Row> more;
    for (const Row& row : rows)
      for (const Level& level : axis.levels) {
        more.push_back(row);
        add(more.back(), level);
      }
    rows = std::move(more);
  }
  return rows;
}

} // namespace billet::study
