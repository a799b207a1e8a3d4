#include "study/trade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace billet::study {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Axes that make a setting and those that make a problem, as positions.
struct Split {
  std::vector<std::size_t> setting, problem;
};

Split split_of(const Study& study) {
  Split split;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    (study.trade->reference.contains(study.axes[a].name) ? split.setting : split.problem)
        .push_back(a);
  return split;
}

std::vector<std::string> labels_of(const Row& row, const std::vector<std::size_t>& axes) {
  std::vector<std::string> labels;
  labels.reserve(axes.size());
  for (const std::size_t a : axes)
    labels.push_back(row.labels[a]);
  return labels;
}

std::vector<std::size_t> quantities_of(const Study& study) {
  std::vector<std::size_t> which;
  const std::vector<std::string>& wanted = study.trade->quantities;
  for (std::size_t q = 0; q < study.quantities.size(); ++q)
    if (wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), study.quantities[q].name) != wanted.end())
      which.push_back(q);
  return which;
}

double error_of(const Study& study,
                const OutcomeRow& row,
                const OutcomeRow& reference,
                const std::vector<std::size_t>& quantities) {
  if (!row.good() || !reference.good())
    return none;
  double largest = 0.0;
  for (const std::size_t q : quantities) {
    const double difference = std::abs(row.values[q] - reference.values[q]);
    const double scale = study.quantities[q].scale.value_or(std::abs(reference.values[q]));
    if (difference > 0.0 && scale == 0.0)
      return none;
    if (difference > 0.0)
      largest = std::max(largest, difference / scale);
  }
  return largest;
}

/// Levels of the setting's axes, as the rows have them.
std::vector<Assignment>
assignments_of(const Study& study, const Row& row, const std::vector<std::size_t>& axes) {
  std::vector<Assignment> set;
  for (const std::size_t a : axes)
    for (const Level& level : study.axes[a].levels)
      if (level.label == row.labels[a])
        set.insert(set.end(), level.set.begin(), level.set.end());
  return set;
}

/// Settings that no other beats in both, from the cheapest on.
std::vector<std::size_t> front_of(std::vector<Setting>& settings) {
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < settings.size(); ++s)
    if (!settings[s].is_reference && std::isfinite(settings[s].error))
      order.push_back(s);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return settings[a].cost < settings[b].cost ||
           (settings[a].cost == settings[b].cost && settings[a].error < settings[b].error);
  });
  std::vector<std::size_t> front;
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t s : order)
    if (settings[s].error < best) {
      best = settings[s].error;
      settings[s].on_front = true;
      front.push_back(s);
    }
  return front;
}

/// The place of the front that lies farthest below the straight line between its ends, both scales
/// logarithmic and of equal length.
std::optional<std::size_t> knee_of(const std::vector<Setting>& settings,
                                   const std::vector<std::size_t>& front) {
  if (front.size() < 3)
    return std::nullopt;
  constexpr double least = 1e-12; // an error of nothing has no logarithm
  const auto x = [&](std::size_t s) { return std::log(settings[s].cost); };
  const auto y = [&](std::size_t s) { return std::log(std::max(settings[s].error, least)); };
  const double width = x(front.back()) - x(front.front()),
               height = y(front.front()) - y(front.back());
  if (!(width > 0.0 && height > 0.0))
    return std::nullopt;
  std::optional<std::size_t> knee;
  double farthest = 0.0;
  for (const std::size_t s : front) {
    const double below =
        1.0 - (x(s) - x(front.front())) / width - (y(s) - y(front.back())) / height;
    if (below > farthest) {
      farthest = below;
      knee = s;
    }
  }
  return knee;
}

/// The rows' errors and costs by problem and setting.
std::vector<TradeProblem> problems_of(const Study& study,
                                      const std::vector<OutcomeRow>& rows,
                                      const Split& split,
                                      const Trade& trade) {
  std::vector<TradeProblem> problems;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::vector<std::string> labels = labels_of(rows[r].row, split.problem),
                                   setting = labels_of(rows[r].row, split.setting);
    auto problem = std::find_if(problems.begin(), problems.end(),
                                [&](const TradeProblem& known) { return known.labels == labels; });
    if (problem == problems.end())
      problem = problems.insert(problem, {labels, std::vector<double>(trade.settings.size(), none),
                                          std::vector<double>(trade.settings.size(), none)});
    const auto place = std::find_if(trade.settings.begin(), trade.settings.end(),
                                    [&](const Setting& known) { return known.labels == setting; });
    const auto s = static_cast<std::size_t>(place - trade.settings.begin());
    problem->errors[s] = trade.errors[r];
    problem->costs[s] = cost_in(study.trade->cost, rows[r].cost);
  }
  return problems;
}

} // namespace

double cost_in(TradeSettings::Cost unit, const RunCost& cost) {
  switch (unit) {
  case TradeSettings::Cost::processor_time:
    return cost.processor_time;
  case TradeSettings::Cost::iterations:
    return cost.iterations;
  case TradeSettings::Cost::memory:
    return 1e-6 * cost.memory;
  }
  return none;
}

std::string unit_of(TradeSettings::Cost unit) {
  switch (unit) {
  case TradeSettings::Cost::processor_time:
    return "s";
  case TradeSettings::Cost::iterations:
    return "iterations";
  case TradeSettings::Cost::memory:
    return "MB";
  }
  return {};
}

Trade trade_of(const Study& study, const std::vector<OutcomeRow>& rows) {
  const Split split = split_of(study);
  const std::vector<std::size_t> quantities = quantities_of(study);
  std::vector<std::string> reference_labels;
  Trade trade;
  for (const std::size_t a : split.setting) {
    trade.axes.push_back(study.axes[a].name);
    reference_labels.push_back(study.trade->reference.at(study.axes[a].name));
  }
  std::map<std::vector<std::string>, const OutcomeRow*> references; // by problem
  for (const OutcomeRow& row : rows)
    if (labels_of(row.row, split.setting) == reference_labels)
      references[labels_of(row.row, split.problem)] = &row;
  for (const std::size_t q : quantities)
    for (const auto& [problem, reference] : references)
      if (reference->good() && reference->values[q] == 0.0 && !study.quantities[q].scale) {
        trade.zero_in_reference.push_back(study.quantities[q].name);
        break;
      }
  std::map<std::vector<std::string>, std::size_t> known;
  std::vector<int> counts;
  for (const OutcomeRow& row : rows) {
    const std::vector<std::string> labels = labels_of(row.row, split.setting);
    const auto [place, is_new] = known.emplace(labels, trade.settings.size());
    if (is_new) {
      trade.settings.push_back({labels, assignments_of(study, row.row, split.setting)});
      trade.settings.back().is_reference = labels == reference_labels;
      counts.push_back(0);
    }
    const double error =
        error_of(study, row, *references.at(labels_of(row.row, split.problem)), quantities);
    trade.errors.push_back(error);
    Setting& setting = trade.settings[place->second];
    setting.error = std::isnan(error) ? std::numeric_limits<double>::infinity()
                                      : std::max(setting.error, error);
    setting.cost += cost_in(study.trade->cost, row.cost);
    ++counts[place->second];
  }
  for (std::size_t s = 0; s < trade.settings.size(); ++s)
    trade.settings[s].cost /= counts[s];
  for (const std::size_t a : split.problem)
    trade.problem_axes.push_back(study.axes[a].name);
  trade.problems = problems_of(study, rows, split, trade);
  trade.front = front_of(trade.settings);
  trade.knee = knee_of(trade.settings, trade.front);
  for (const std::size_t s : trade.front) // from the cheapest on
    if (!trade.cheapest_within && trade.settings[s].error <= study.trade->within)
      trade.cheapest_within = s;
  return trade;
}

} // namespace billet::study
