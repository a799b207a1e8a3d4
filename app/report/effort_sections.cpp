#include "app/report/html.h"
#include "app/report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

/// Bars of the share that each part has of the whole.
std::string bars(const ordered_json& seconds) {
  const double total = std::max(seconds.value("total", 0.0), 1e-12);
  std::vector<std::pair<std::string, double>> parts;
  for (const auto& [name, value] : seconds.items())
    if (name != "total" && value.is_number())
      parts.emplace_back(name, value.get<double>());
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : parts)
    rows.push_back({escaped(name), number(value), fmt::format("{:.1f} %", 100.0 * value / total),
                    fmt::format("<span class=\"bar\" style=\"width:{:.1f}%\"></span>",
                                std::clamp(100.0 * value / total, 0.0, 100.0))});
  rows.push_back({"<b>total</b>", number(total), "100 %", ""});
  return table({"part of the run", "seconds", "share", ""}, rows);
}

std::string solver(const ordered_json& summary) {
  Facts rows;
  const ordered_json work = summary.value("linear_solver", ordered_json::object());
  const auto add = [&](const ordered_json& from, const char* key, const char* words,
                       double factor = 1.0) {
    if (from.contains(key) && from[key].is_number())
      rows.emplace_back(words, number(factor * from[key].get<double>()));
  };
  add(summary, "iterations", "iterations of accepted increments");
  add(summary, "iterations_of_failed_tries", "iterations of tries that were refused");
  add(summary, "iterations_on_new_meshes", "iterations on new meshes");
  add(summary, "cutbacks", "cut-backs");
  add(work, "systems", "linear systems");
  add(work, "factorizations", "factorizations");
  add(work, "reused", "systems solved with an earlier factorization");
  add(work, "multigrid", "systems for multigrid");
  add(work, "gigaflop_per_second", "GFLOP/s of factorizations");
  const ordered_json last = work.value("last", ordered_json::object());
  if (last.contains("method"))
    rows.emplace_back("last factorization by", escaped(last.value("method", "")));
  add(last, "megabytes", "its factors [MB]");
  const ordered_json resources = summary.value("resources", ordered_json::object());
  add(resources, "processor_seconds", "processor time [s]");
  constexpr double megabyte = 1e-6;
  add(resources, "peak_memory_bytes", "largest memory [MB]", megabyte);
  return rows.empty() ? std::string() : facts(rows);
}

/// A row of the ledger; change of a quantity that has a value before and after.
std::string change(const io::CsvTable& ledger, std::size_t row, const std::string& what) {
  const std::vector<double> before = column(ledger, what + "_before");
  const std::vector<double> after = column(ledger, what + "_after");
  if (row >= before.size() || row >= after.size() || !(before[row] > 0.0))
    return "–";
  return fmt::format("{:+.2g} %", 100.0 * (after[row] / before[row] - 1.0));
}

std::vector<std::string> row_of_ledger(const io::CsvTable& ledger, std::size_t row) {
  const auto cell = [&](const char* name) {
    const std::optional<std::size_t> found = ledger.find(name);
    return found ? ledger.rows[row][*found] : std::string();
  };
  const auto figure = [&](const char* name) {
    const std::vector<double> values = column(ledger, name);
    return row < values.size() ? values[row] : NAN;
  };
  return {escaped(cell("remeshing")),
          number(figure("time")),
          escaped(cell("cause")),
          escaped(cell("elements_before") + " → " + cell("elements_after")),
          number(figure("quality_before")) + " → " + number(figure("quality_after")),
          change(ledger, row, "volume"),
          change(ledger, row, "plastic_work"),
          fmt::format("{:.2g} %", 100.0 * figure("force_jump")),
          cell("balanced") == "1" ? "yes" : "no",
          escaped(cell("solved_again")),
          number(figure("seconds"))};
}

} // namespace

std::string remeshing_section(const ResultsFolder& results) {
  const io::CsvTable& ledger = results.remeshings;
  if (ledger.rows.empty())
    return {};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t row = 0; row < ledger.rows.size(); ++row)
    rows.push_back(row_of_ledger(ledger, row));
  std::string html =
      table({"no.", "time<br><small>[" + escaped(results.units().time) + "]</small>", "cause",
             "elements", "worst quality", "volume", "plastic work", "force jump", "balanced",
             "increments solved again", "took<br><small>[s]</small>"},
            rows);
  constexpr std::size_t many = 15;
  if (rows.size() > many)
    html = folded(fmt::format("{} new meshes", rows.size()), html, false);
  return section("remeshing", "Remeshing ledger", html);
}

std::string effort_section(const ResultsFolder& results) {
  if (!results.summary.contains("seconds"))
    return {};
  return section("effort", "Where the time went",
                 "<div class=\"columns\">" + bars(results.summary["seconds"]) +
                     solver(results.summary) + "</div>\n");
}

} // namespace billet::report
