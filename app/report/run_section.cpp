#include "app/report/html.h"
#include "app/report/sections.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    return {};
  const ordered_json& value = object[key];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void add(Facts& rows, const std::string& what, const std::string& value) {
  if (!value.empty())
    rows.emplace_back(what, escaped(value));
}

/// How the run was started, and each time it went on.
void add_starts(Facts& rows, const ordered_json& starts) {
  bool first = true;
  for (const ordered_json& start : starts) {
    add(rows, first ? "Started" : "Went on", text_of(start, "begun"));
    if (const std::string command = text_of(start, "command"); !command.empty())
      rows.emplace_back("Command", "<code>" + escaped(command) + "</code>");
    add(rows, "In folder", text_of(start, "folder"));
    std::string machine = text_of(start, "machine");
    if (const std::string processor = text_of(start, "processor"); !processor.empty())
      machine += ", " + processor;
    if (const std::string cores = text_of(start, "cores"); !cores.empty())
      machine += ", " + cores + " cores";
    add(rows, "Machine", machine);
    add(rows, "System", text_of(start, "system"));
    first = false;
  }
}

std::string size_of_model(const ordered_json& summary) {
  if (!summary.contains("elements"))
    return {};
  return fmt::format("{} elements {}, {} nodes, {} unknowns (at the end)",
                     text_of(summary, "elements"), text_of(summary, "element"),
                     text_of(summary, "nodes"), text_of(summary, "unknowns"));
}

} // namespace

std::string run_section(const ResultsFolder& results) {
  const ordered_json& summary = results.summary;
  Facts rows;
  add(rows, "Title", results.title);
  add(rows, "Case", results.name);
  const std::vector<std::string> versions = results.said("billet ");
  add(rows, "Program",
      versions.empty() ? "billet " + text_of(summary, "billet") : "billet " + versions.front());
  add_starts(rows, results.starts);
  if (results.writer)
    add(rows, "Running",
        fmt::format("process {} on {}, since {}", results.writer->process, results.writer->machine,
                    results.writer->since));
  add(rows, "Analysis", text_of(summary, "analysis"));
  add(rows, "Model", size_of_model(summary));
  add(rows, "Units", results.units().name);
  std::error_code error;
  add(rows, "Results", std::filesystem::absolute(results.path, error).lexically_normal().string());
  add(rows, "Report made",
      fmt::format("{:%Y-%m-%d %H:%M:%S %z}", fmt::localtime(std::time(nullptr))));
  std::string html = facts(rows);
  if (!results.case_text.empty())
    html += folded("Case, with every default filled in (case.resolved.toml)",
                   "<pre>" + escaped(results.case_text) + "</pre>\n", false);
  return html;
}

} // namespace billet::report
