#include "app/report/results_folder.h"

#include "geometry/base/error.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace billet::report {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Empty if there is no such file.
std::string text_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// A table, whose last row may be only half written.
io::CsvTable table_of(const fs::path& file, ResultsFolder& results) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) == 0)
    return {};
  try {
    io::CsvTable table = io::read_csv(file);
    if (!table.rows.empty() && !table.rows.back().empty() && table.rows.back().back().empty())
      table.rows.pop_back();
    return table;
  } catch (const Error& wrong) {
    results.unreadable.emplace_back(wrong.what());
    return {};
  }
}

ordered_json json_of(const fs::path& file, ordered_json otherwise, ResultsFolder& results) {
  const std::string text = text_of_file(file);
  if (text.empty())
    return otherwise;
  ordered_json json = ordered_json::parse(text, nullptr, false);
  if (json.is_discarded() || json.type() != otherwise.type()) {
    results.unreadable.push_back(file.string() + ": is damaged");
    return otherwise;
  }
  return json;
}

std::string name_of(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".pvd")
      return entry.path().stem().string();
  return fs::absolute(folder).lexically_normal().filename().string();
}

void require_results(const fs::path& folder) {
  constexpr std::string_view remedy = "give the folder a run wrote its results to";
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw Error(Fault::input_output, folder.string(),
                fs::exists(folder, error) ? "is not a folder" : "the folder does not exist",
                std::string(remedy));
  for (const char* file : {"case.resolved.toml", "history.csv", "summary.json"})
    if (fs::exists(folder / file, error))
      return;
  throw Error(Fault::input_output, folder.string(), "holds no results of a run",
              std::string(remedy));
}

} // namespace

ResultsFolder read_results(const fs::path& folder) {
  require_results(folder);
  ResultsFolder results;
  results.path = folder;
  // Before the summary is looked for: a run that ends now has written it before it lets go.
  results.writer = io::run_writing_to(folder);
  results.summary = json_of(folder / "summary.json", ordered_json::object(), results);
  results.starts = json_of(folder / "starts.json", ordered_json::array(), results);
  const bool ended = results.summary.contains("status");
  results.state = ended ? RunState::ended : results.writer ? RunState::running : RunState::killed;
  results.name = name_of(folder);
  results.case_text = text_of_file(folder / "case.resolved.toml");
  results.facts = case_facts(results.case_text);
  results.title = results.facts.title.empty() ? results.name : results.facts.title;
  results.log = lines_of(text_of_file(folder / "run.log"));
  results.post_mortem = text_of_file(folder / "failure" / "post_mortem.txt");
  results.history = table_of(folder / "history.csv", results);
  results.iterations = table_of(folder / "iterations.csv", results);
  results.remeshings = table_of(folder / "remesh.csv", results);
  return results;
}

std::string ResultsFolder::status() const {
  switch (state) {
  case RunState::running:
    return "running";
  case RunState::killed:
    return "killed";
  case RunState::ended:
    break;
  }
  return summary.value("status", "");
}

std::optional<int> ResultsFolder::exit_status() const {
  return state == RunState::ended ? std::optional(summary.value("exit_status", 0)) : std::nullopt;
}

std::vector<std::string> ResultsFolder::said(std::string_view beginning) const {
  std::vector<std::string> lines;
  for (const std::string& line : log)
    if (line.starts_with(beginning))
      lines.push_back(line.substr(beginning.size()));
  return lines;
}

std::vector<std::string> ResultsFolder::tools() const {
  constexpr std::string_view suffix = ".displacement_x"; // supports have forces alone
  std::vector<std::string> names;
  for (const std::string& heading : history.columns)
    if (heading.ends_with(suffix))
      names.push_back(heading.substr(0, heading.size() - suffix.size()));
  return names;
}

std::vector<double> column(const io::CsvTable& table, std::string_view name) {
  const std::optional<std::size_t> found = table.find(name);
  return found ? table.numbers(*found) : std::vector<double>();
}

} // namespace billet::report
