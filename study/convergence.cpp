#include "study/convergence.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

namespace billet::study {

namespace {

/// Rows by the labels of all axes.
using RowsByLabels = std::map<std::vector<std::string>, const OutcomeRow*>;

std::vector<std::size_t> converged_axes(const Study& study) {
  std::vector<std::size_t> axes;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const std::vector<std::string>& wanted = study.convergence->axes;
    if (std::find(wanted.begin(), wanted.end(), study.axes[a].name) != wanted.end())
      axes.push_back(a);
  }
  return axes;
}

/// Values along an axis, the other labels as given; those of runs that failed are left out.
AxisConvergence along(const Axis& axis,
                      std::size_t position,
                      std::size_t quantity,
                      std::vector<std::string> labels,
                      const RowsByLabels& rows) {
  AxisConvergence line;
  line.axis = axis.name;
  for (const Level& level : axis.levels) {
    labels[position] = level.label;
    const auto found = rows.find(labels);
    if (found == rows.end() || !found->second->good())
      continue;
    line.labels.push_back(level.label);
    line.sizes.push_back(*level.size);
    line.values.push_back(found->second->values[quantity]);
  }
  return line;
}

std::optional<Convergence> converge(const Study& study,
                                    const std::vector<std::size_t>& axes,
                                    const std::vector<std::string>& finest,
                                    std::size_t quantity,
                                    const RowsByLabels& rows) {
  const auto reference = rows.find(finest);
  if (reference == rows.end() || !reference->second->good())
    return std::nullopt;
  Convergence result;
  result.quantity = study.quantities[quantity].name;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (std::find(axes.begin(), axes.end(), a) == axes.end())
      result.problem.push_back(finest[a]);
  result.finest = result.limit = reference->second->values[quantity];
  for (const std::size_t a : axes) {
    AxisConvergence line = along(study.axes[a], a, quantity, finest, rows);
    if (line.values.size() < 3)
      return std::nullopt;
    line.extrapolation = extrapolate(line.sizes, line.values);
    const auto place = static_cast<std::size_t>(
        std::min_element(line.sizes.begin(), line.sizes.end()) - line.sizes.begin());
    result.limit += line.extrapolation.limit - result.finest;
    result.uncertainty += line.extrapolation.uncertainty[place];
    result.along.push_back(std::move(line));
  }
  return result;
}

} // namespace

std::vector<Convergence> convergence_of(const Study& study, const std::vector<OutcomeRow>& rows) {
  const std::vector<std::size_t> axes = converged_axes(study);
  RowsByLabels by_labels;
  std::set<std::vector<std::string>> combinations; // at the finest levels
  for (const OutcomeRow& row : rows) {
    by_labels[row.row.labels] = &row;
    std::vector<std::string> labels = row.row.labels;
    for (const std::size_t a : axes)
      labels[a] = study.axes[a].finest().label;
    combinations.insert(labels);
  }
  const std::vector<std::string>& wanted = study.convergence->quantities;
  std::vector<Convergence> results;
  for (const std::vector<std::string>& labels : combinations)
    for (std::size_t q = 0; q < study.quantities.size(); ++q) {
      if (!wanted.empty() &&
          std::find(wanted.begin(), wanted.end(), study.quantities[q].name) == wanted.end())
        continue;
      if (std::optional<Convergence> result = converge(study, axes, labels, q, by_labels))
        results.push_back(std::move(*result));
    }
  return results;
}

} // namespace billet::study
