#include "app/report/html.h"
#include "app/report/sections.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

struct Verdict {
  std::string tone; ///< class of the box: good, bad, busy
  std::string words;
};

Verdict verdict_on(const ResultsFolder& results) {
  static const std::map<std::string, Verdict> verdicts{
      {"done", {"good", "The run has come to its end, and its result passes all checks."}},
      {"failed-checks",
       {"bad", "The run has come to its end, but its result fails a check and must not be used."}},
      {"not-converged",
       {"bad", "The run could not go on. Results up to the last good increment are valid."}},
      {"stopped", {"bad", "The run was stopped by a signal. Results until there are valid."}},
      {"running", {"busy", "The run is going on. This page shows it as far as it has come."}},
      {"killed",
       {"bad", "The run has not come to its end, and nobody writes here any more: it was killed. "
               "Results are valid as far as they go."}}};
  const auto found = verdicts.find(results.status());
  return found != verdicts.end() ? found->second : Verdict{"bad", "The status is unknown."};
}

std::string progress_of(const ResultsFolder& results) {
  const std::vector<double> times = column(results.history, "time");
  const double time = times.empty() ? 0.0 : times.back();
  std::string text = fmt::format("time {} {}", number(time), escaped(results.units().time));
  if (const std::optional<double> end = results.facts.end; end && *end > 0.0)
    text = fmt::format("time {} of {} {} ({:.0f} %)", number(time), number(*end),
                       escaped(results.units().time), 100.0 * time / *end);
  text += fmt::format(", {} increments", results.history.rows.size());
  if (const std::string by = results.summary.value("ended_by", "");
      !by.empty() && results.status() == "done")
    text += ", ended by: " + escaped(by);
  return text;
}

std::vector<std::string> texts_in(const ordered_json& array) {
  std::vector<std::string> lines;
  for (const ordered_json& line : array)
    if (line.is_string())
      lines.push_back(line.get<std::string>());
  return lines;
}

std::string callout(const std::string& tone, const std::string& title, const std::string& content) {
  return content.empty() ? std::string()
                         : fmt::format("<div class=\"callout {}\"><h3>{}</h3>\n{}</div>\n", tone,
                                       title, content);
}

/// Of a run without a summary those of its log.
std::vector<std::string> warnings_of(const ResultsFolder& results) {
  std::vector<std::string> lines = results.summary.contains("warnings")
                                       ? texts_in(results.summary["warnings"])
                                       : results.said("warning: ");
  for (std::string& line : lines)
    if (line.starts_with("warning: "))
      line.erase(0, std::string_view("warning: ").size());
  return lines;
}

std::vector<std::string> failed_checks_of(const ResultsFolder& results) {
  std::vector<std::string> lines;
  if (results.summary.contains("failed_checks"))
    for (const ordered_json& check : results.summary["failed_checks"])
      lines.push_back(check.value("check", "") + ": " + check.value("what", ""));
  return lines;
}

std::string failure_of(const ResultsFolder& results) {
  std::string html;
  if (results.summary.contains("failure")) {
    const ordered_json& failure = results.summary["failure"];
    html += fmt::format("<p>Time {} {} could not be reached: {}</p>\n",
                        number(failure.value("time", NAN)), escaped(results.units().time),
                        escaped(failure.value("reason", "")));
  }
  if (!results.post_mortem.empty())
    html += folded("failure/post_mortem.txt", "<pre>" + escaped(results.post_mortem) + "</pre>\n",
                   false);
  return html;
}

std::string tile(const std::string& value, const std::string& unit, const std::string& what) {
  return fmt::format("<div class=\"tile\"><b>{}</b> <span>{}</span><small>{}</small></div>\n",
                     value, escaped(unit), what);
}

} // namespace

std::string status_section(const ResultsFolder& results) {
  const Verdict verdict = verdict_on(results);
  std::string html =
      fmt::format("<div class=\"verdict {}\"><strong>{}</strong><p>{}</p><p>{}</p></div>\n",
                  verdict.tone, escaped(results.status()), verdict.words, progress_of(results));
  html += callout("bad", "Failed checks", list(failed_checks_of(results)));
  html += callout("bad", "Failure", failure_of(results));
  html += callout("warn", "Warnings", list(warnings_of(results)));
  html += callout("note", "What may help", list(results.said("what may help: ")));
  html += callout("warn", "Could not be read", list(results.unreadable));
  return html;
}

std::string key_figures(const ResultsFolder& results, const std::vector<NamedChart>& charts) {
  const io::UnitSystem units = results.units();
  std::string tiles;
  for (const NamedChart& chart : charts) {
    if (chart.id != "force-time" && !(chart.id == "load-stroke" && chart.over_time))
      continue;
    double largest = 0.0;
    std::string tool;
    for (const render::Curve& curve : chart.chart.curves)
      for (const Vec2& value : curve.values)
        if (value[1] > largest) {
          largest = value[1];
          tool = curve.label;
        }
    const std::size_t bracket = chart.chart.y_label.find('[');
    std::string unit = bracket == std::string::npos ? "" : chart.chart.y_label.substr(bracket + 1);
    if (unit.ends_with("]"))
      unit.pop_back();
    if (!tool.empty())
      tiles += tile(number(largest), unit, "largest force, on " + escaped(tool));
  }
  const auto last = [&](const char* name) {
    const std::vector<double> values = column(results.history, name);
    return values.empty() ? NAN : values.back();
  };
  const auto most = [&](const char* name) {
    double largest = NAN;
    for (const double value : column(results.history, name))
      largest = std::fmax(largest, value);
    return largest;
  };
  if (results.history.rows.empty())
    return {};
  tiles += tile(number(most("max_plastic_strain")), "", "largest plastic strain");
  tiles += tile(number(most("max_penetration")), units.length, "penetration, certified bound");
  if (last("remeshings") > 0.0)
    tiles += tile(number(last("remeshings")), "", "new meshes");
  tiles += tile(fmt::format("{}", results.history.rows.size()), "", "increments");
  tiles += tile(number(last("wall_time")), "s", "of wall-clock time");
  return "<div class=\"tiles\">\n" + tiles + "</div>\n";
}

} // namespace billet::report
