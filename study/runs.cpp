#include "study/runs.h"

#include "geometry/base/error.h"
#include "io/case/document.h"
#include "io/case/history_columns.h"
#include "io/case/read_case.h"
#include "io/deck/deck_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

#include "study/file_text.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;

/// FNV-1a of 64 bits (Fowler, Noll and Vo): same everywhere.
class Checksum {
public:
  void add(std::string_view text) {
    for (const char c : text)
      sum_ = (sum_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    sum_ = (sum_ ^ 0xffU) * 1099511628211ULL; // "ab" "c" is not "a" "bc"
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", sum_); }

private:
  std::uint64_t sum_ = 14695981039346656037ULL;
};

/// Adds the contents of a file, of a mesh as a deck with what it includes.
void add_file(const fs::path& file, Checksum& checksum) {
  if (file.extension() != ".inp") {
    checksum.add(text_of_file(file));
    return;
  }
  io::DeckLines deck(file, {.folder = {}, .anywhere = true});
  while (const std::optional<io::DeckKeyword> keyword = deck.next()) {
    checksum.add(keyword->name);
    for (const auto& [name, value] : keyword->parameters) {
      checksum.add(name);
      checksum.add(value);
    }
    for (const std::vector<std::string>& line : keyword->data)
      for (const std::string& field : line)
        checksum.add(field);
  }
}

/// Adds the contents of all files that texts of a tree name.
void add_files(const io::Node& node, const fs::path& folder, Checksum& checksum) {
  if (const auto* const text = node.as<std::string>()) {
    std::error_code error;
    const fs::path file = folder / *text;
    if (!text->empty() && text->find('\n') == std::string::npos && fs::is_regular_file(file, error))
      add_file(file, checksum);
  } else if (const auto* const list = node.as<io::List>()) {
    for (const io::Node& item : *list)
      add_files(item, folder, checksum);
  } else if (const auto* const table = node.as<io::Table>()) {
    for (const io::Entry& entry : table->entries)
      add_files(entry.node, folder, checksum);
  }
}

std::string
identity_of(const io::Case& content, const fs::path& case_file, const std::string& version) {
  Checksum checksum;
  checksum.add(version);
  const std::string resolved = io::resolved_toml(content);
  checksum.add(resolved);
  add_files(io::parse_document(resolved, "case"), case_file.parent_path(), checksum);
  return checksum.text();
}

/// Why a run failed, by its summary or else by what it printed last.
std::string reason_of(const fs::path& folder) {
  std::ifstream stream(folder / "results" / "summary.json");
  const nlohmann::json summary = nlohmann::json::parse(stream, nullptr, false);
  if (summary.is_object() && summary.contains("failure"))
    return summary["failure"].value("reason", "");
  if (summary.is_object() && summary.contains("failed_checks") && !summary["failed_checks"].empty())
    return "failed check: " + summary["failed_checks"][0].value("what", "");
  std::ifstream output(folder / "output.txt");
  std::string last;
  for (std::string line; std::getline(output, line);)
    if (!line.empty() && (last.empty() || line.find("error") != std::string::npos))
      last = line;
  return last;
}

} // namespace

PlannedRun
plan_run(const Study& study, const Row& row, const fs::path& runs, const Program& program) {
  std::vector<std::string> overrides = study.overrides;
  for (const std::string& word : row.overrides())
    overrides.push_back(word);
  const fs::path& case_file = row.case_file ? *row.case_file : study.case_file;
  PlannedRun run;
  try {
    io::Case content = io::read_case(case_file, overrides, {true});
    if (!study.engine.frames) {
      content.output.every = content.time.end;
      overrides.push_back(fmt::format("output.every={}", content.time.end));
    }
    run.identity = identity_of(content, case_file, program.version);
    run.columns = io::history_columns(content);
  } catch (const Error& error) {
    run.refused = error.what();
    return run;
  }
  run.folder = runs / run.identity;
  run.command = {program.file.string(), "run", fs::absolute(case_file).string()};
  for (const std::string& word : overrides) {
    run.command.emplace_back("--set");
    run.command.push_back(word);
  }
  for (const char* word : {"--allow-outside", "--quiet", "--threads"})
    run.command.emplace_back(word);
  run.command.push_back(std::to_string(study.engine.threads));
  run.command.emplace_back("-o");
  run.command.push_back(fs::absolute(run.folder / "results").string());
  return run;
}

std::optional<EndedRun> ended(const PlannedRun& run) {
  if (!run.refused.empty())
    return EndedRun{static_cast<int>(Fault::case_file), run.refused};
  std::ifstream stream(run.folder / "exit_status");
  int status = 0;
  constexpr int by_signal = 128;
  if (!(stream >> status) || status >= by_signal)
    return std::nullopt;
  return EndedRun{status, status == 0 ? "" : reason_of(run.folder)};
}

std::vector<std::string> command_of(const PlannedRun& run) {
  std::vector<std::string> command = run.command;
  std::error_code error;
  if (const fs::path checkpoints = run.folder / "results" / "checkpoints";
      fs::is_directory(checkpoints, error) && !fs::is_empty(checkpoints, error))
    command.emplace_back("--resume");
  return command;
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string shell_line(const PlannedRun& run) {
  std::vector<std::string> words;
  for (const std::string& word : command_of(run))
    words.push_back(quoted(word));
  const std::string folder = fs::absolute(run.folder).string();
  return fmt::format("mkdir -p {0}; {1} >{2} 2>&1 </dev/null; echo $? >{3}", quoted(folder),
                     fmt::join(words, " "), quoted(folder + "/output.txt"),
                     quoted(folder + "/exit_status"));
}

} // namespace billet::study
