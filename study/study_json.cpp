#include "study/study_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace billet::study {

namespace {

using nlohmann::ordered_json;

ordered_json rows_json(const Study& study, const std::vector<OutcomeRow>& rows) {
  ordered_json list = ordered_json::array();
  for (const OutcomeRow& row : rows) {
    ordered_json json;
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      json["settings"][study.axes[a].name] = row.row.labels[a];
    for (const Assignment& assignment : row.row.assignments)
      json["set"][assignment.key] = assignment.value;
    if (row.end) {
      json["status"] = row.end->status;
      json["reason"] = row.end->reason;
    }
    for (std::size_t q = 0; q < row.values.size(); ++q) // null: not a number
      json["quantities"][study.quantities[q].name] = row.values[q];
    json["cost"] = {{"processor_time", row.cost.processor_time},
                    {"iterations", row.cost.iterations},
                    {"memory_bytes", row.cost.memory}};
    json["folder"] = row.folder;
    list.push_back(std::move(json));
  }
  return list;
}

ordered_json setting_json(const Trade& trade, const Setting& setting) {
  ordered_json json;
  for (std::size_t a = 0; a < trade.axes.size(); ++a)
    json["settings"][trade.axes[a]] = setting.labels[a];
  if (std::isfinite(setting.error))
    json["error"] = setting.error;
  json["cost"] = setting.cost;
  json["is_reference"] = setting.is_reference;
  json["on_front"] = setting.on_front;
  return json;
}

ordered_json trade_json(const Study& study, const Trade& trade) {
  ordered_json json{{"cost_unit", unit_of(study.trade->cost)}, {"within", study.trade->within}};
  json["settings"] = ordered_json::array();
  for (const Setting& setting : trade.settings)
    json["settings"].push_back(setting_json(trade, setting));
  json["front"] = trade.front;
  if (trade.knee)
    json["knee"] = *trade.knee;
  if (trade.cheapest_within)
    json["cheapest_within"] = *trade.cheapest_within;
  return json;
}

ordered_json convergence_json(const std::vector<Convergence>& all) {
  ordered_json list = ordered_json::array();
  for (const Convergence& each : all) {
    ordered_json json{{"problem", each.problem},
                      {"quantity", each.quantity},
                      {"finest", each.finest},
                      {"extrapolated", each.limit},
                      {"uncertainty", each.uncertainty}};
    for (const AxisConvergence& line : each.along)
      json["along"].push_back({{"axis", line.axis},
                               {"levels", line.labels},
                               {"sizes", line.sizes},
                               {"values", line.values},
                               {"range", in_words(line.extrapolation.range)},
                               {"order", line.extrapolation.order},
                               {"extrapolated", line.extrapolation.limit},
                               {"uncertainty", line.extrapolation.uncertainty}});
    list.push_back(std::move(json));
  }
  return list;
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100.0 * share) : "failed";
}

/// As lines to paste into a case, and as options.
std::string to_paste(const Setting& setting) {
  std::string text;
  for (const Assignment& assignment : setting.assignments)
    text += fmt::format("    {} = {}\n", assignment.key, assignment.value);
  return text;
}

std::string remark_of(const Trade& trade, std::size_t s) {
  std::vector<std::string> remarks;
  if (trade.settings[s].is_reference)
    remarks.emplace_back("reference");
  if (trade.settings[s].on_front)
    remarks.emplace_back("front");
  if (trade.knee == s)
    remarks.emplace_back("knee");
  if (trade.cheapest_within == s)
    remarks.emplace_back("cheapest good enough");
  return fmt::format("{}", fmt::join(remarks, ", "));
}

/// Text as it stands in a cell of a Markdown table.
std::string in_cell(const std::string& text) {
  std::string cell;
  for (const char c : text)
    cell += c == '|' ? "\\|" : std::string(1, c == '\n' ? ' ' : c);
  return cell;
}

std::string in_cells(const std::vector<std::string>& texts, std::string_view between) {
  std::vector<std::string> cells(texts.size());
  std::transform(texts.begin(), texts.end(), cells.begin(), in_cell);
  return fmt::format("{}", fmt::join(cells, between));
}

std::string trade_text(const Study& study, const Trade& trade) {
  std::string text = fmt::format("| {} | error | cost [{}] | |\n|", in_cells(trade.axes, " | "),
                                 unit_of(study.trade->cost));
  for (std::size_t i = 0; i < trade.axes.size() + 3; ++i)
    text += "---|";
  text += '\n';
  for (std::size_t s = 0; s < trade.settings.size(); ++s) {
    const Setting& setting = trade.settings[s];
    text += fmt::format("| {} | {} | {:.4g} | {} |\n", in_cells(setting.labels, " | "),
                        percent(setting.error), setting.cost, remark_of(trade, s));
  }
  if (std::any_of(trade.settings.begin(), trade.settings.end(), [](const Setting& setting) {
        return setting.is_reference && !std::isfinite(setting.error);
      }))
    text +=
        "\nA reference gave no figures to compare with: no setting has an error. Choose another "
        "one, or repeat its run.\n";
  for (const std::string& name : trade.zero_in_reference)
    text += fmt::format("\n{} is 0 in a reference: its errors are relative to nothing. Give the "
                        "quantity a scale.\n",
                        name);
  if (trade.cheapest_within)
    text += fmt::format("\nThe cheapest within {}:\n\n{}", percent(study.trade->within),
                        to_paste(trade.settings[*trade.cheapest_within]));
  else if (std::all_of(trade.settings.begin(), trade.settings.end(),
                       [](const Setting& setting) { return setting.is_reference; }))
    text += "\nThere is no setting but the reference.\n";
  else
    text += fmt::format("\nNo setting is within {}.\n", percent(study.trade->within));
  if (trade.knee)
    text += fmt::format("\nThe knee, beyond which a smaller error costs most:\n\n{}",
                        to_paste(trade.settings[*trade.knee]));
  return text;
}

/// What each setting makes of each problem: its error and its cost; empty: there is one problem.
std::string problems_text(const Study& study, const Trade& trade) {
  if (trade.problems.size() < 2)
    return {};
  std::string text = fmt::format("\nError and cost [{}] by problem:\n\n| {} |",
                                 unit_of(study.trade->cost), in_cells(trade.problem_axes, " | "));
  for (const Setting& setting : trade.settings)
    text += fmt::format(" {} |", in_cells(setting.labels, ", "));
  text += "\n|";
  for (std::size_t i = 0; i < trade.problem_axes.size() + trade.settings.size(); ++i)
    text += "---|";
  text += '\n';
  for (const TradeProblem& problem : trade.problems) {
    text += fmt::format("| {} |", in_cells(problem.labels, " | "));
    for (std::size_t s = 0; s < trade.settings.size(); ++s)
      text += fmt::format(" {}, {:.4g} |", percent(problem.errors[s]), problem.costs[s]);
    text += '\n';
  }
  return text;
}

std::string convergence_text(const Study& study, const std::vector<Convergence>& all) {
  std::vector<std::string> problems;
  for (const Axis& axis : study.axes) {
    const std::vector<std::string>& over = study.convergence->axes;
    if (std::find(over.begin(), over.end(), axis.name) == over.end())
      problems.push_back(axis.name);
  }
  std::string text = "|";
  for (const std::string& name : problems)
    text += fmt::format(" {} |", in_cell(name));
  text += " quantity | finest | extrapolated | uncertainty of the finest | over | order | |\n|";
  for (std::size_t i = 0; i < problems.size() + 7; ++i)
    text += "---|";
  text += '\n';
  for (const Convergence& each : all)
    for (std::size_t i = 0; i < each.along.size(); ++i) {
      const AxisConvergence& line = each.along[i];
      text += "|";
      for (const std::string& label : each.problem)
        text += fmt::format(" {} |", in_cell(label));
      text += fmt::format(
          " {} | {:.6g} | {:.6g} | {:.2g} ({}) | {} | {} | {} |\n", each.quantity, each.finest,
          each.limit, each.uncertainty,
          each.finest != 0.0 ? percent(each.uncertainty / std::abs(each.finest)) : "-", line.axis,
          line.extrapolation.order > 0.0 ? fmt::format("{:.2g}", line.extrapolation.order) : "-",
          in_words(line.extrapolation.range));
    }
  if (all.empty())
    text += "\nNothing is extrapolated: fewer than three levels of an axis have a value.\n";
  return text;
}

} // namespace

Findings findings_of(const Study& study, const std::vector<OutcomeRow>& rows) {
  Findings findings;
  if (study.trade)
    findings.trade = trade_of(study, rows);
  if (study.convergence)
    findings.convergence = convergence_of(study, rows);
  return findings;
}

std::string
json_text(const Study& study, const std::vector<OutcomeRow>& rows, const Findings& findings) {
  ordered_json json{{"title", study.title}, {"case", study.case_file.string()}};
  json["rows"] = rows_json(study, rows);
  if (findings.trade)
    json["trade"] = trade_json(study, *findings.trade);
  if (study.convergence)
    json["convergence"] = convergence_json(findings.convergence);
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string in_words(const Study& study, const Findings& findings) {
  std::string text;
  if (findings.trade)
    text += trade_text(study, *findings.trade) + problems_text(study, *findings.trade);
  if (study.convergence)
    text += (text.empty() ? "" : "\n") + convergence_text(study, findings.convergence);
  return text;
}

} // namespace billet::study
