#include "study/conduct.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"
#include "io/results/folder_lock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <thread>

#include "study/expression.h"
#include "study/local_engine.h"
#include "study/slurm_engine.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;

/// A run to be made, once, for the first of the rows that ask for it.
struct Pending {
  const PlannedRun* run;
  std::size_t row;
};

/// Whether results are there that quantities can be read off.
bool has_results(const PlannedRun& run) {
  return fs::exists(run.folder / "results" / "summary.json") &&
         fs::exists(run.folder / "results" / "history.csv");
}

std::vector<Pending> pending_of(const std::vector<PlannedRun>& runs, bool again) {
  std::set<std::string> seen;
  std::vector<Pending> pending;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const PlannedRun& run = runs[r];
    if (!run.refused.empty() || !seen.insert(run.identity).second)
      continue;
    const std::optional<EndedRun> end = ended(run);
    if (!end || (again && (end->status != 0 || !has_results(run))))
      pending.push_back({&run, r});
  }
  return pending;
}

std::string settings_in_words(const Study& study, const Row& row) {
  std::vector<std::string> words;
  words.reserve(study.axes.size());
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    words.push_back(fmt::format("{} = {}", study.axes[a].name, row.labels[a]));
  if (words.empty()) // of a chart
    words = row.labels;
  return words.empty() ? "the case as it is" : fmt::format("{}", fmt::join(words, ", "));
}

void note_status(const PlannedRun& run, int status) {
  io::write_file(run.folder / "exit_status", std::to_string(status) + "\n");
}

int processes_of(const Engine& engine) {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return engine.processes.value_or(std::max(1, cores / engine.threads));
}

void run_here(const Study& study,
              const std::vector<Row>& rows,
              const std::vector<Pending>& pending,
              const Conduct& how) {
  std::vector<Job> jobs;
  for (const Pending& each : pending) {
    fs::create_directories(each.run->folder);
    std::error_code error;
    fs::remove(each.run->folder / "exit_status", error);
    jobs.push_back({command_of(*each.run), each.run->folder / "output.txt"});
  }
  std::size_t n_ended = 0;
  run_jobs(jobs, processes_of(study.engine), how.stopped, [&](std::size_t job, int status) {
    note_status(*pending[job].run, status);
    const std::optional<EndedRun> end = ended(*pending[job].run);
    how.say(fmt::format("{} of {}: {}: {}", ++n_ended, jobs.size(),
                        settings_in_words(study, rows[pending[job].row]),
                        !end               ? "stopped"
                        : end->status == 0 ? "done"
                                           : fmt::format("status {}, {}", status, end->reason)));
  });
}

void make_runs(const Study& study,
               const std::vector<Row>& rows,
               const std::vector<Pending>& pending,
               const Conduct& how) {
  if (pending.empty())
    return;
  if (study.engine.kind == Engine::Kind::local) {
    run_here(study, rows, pending, how);
    return;
  }
  std::vector<std::string> lines;
  lines.reserve(pending.size());
  for (const Pending& each : pending)
    lines.push_back(shell_line(*each.run));
  const fs::path list = how.folder / "commands.txt";
  io::write_file(list, fmt::format("{}\n", fmt::join(lines, "\n")));
  if (study.engine.kind == Engine::Kind::commands) {
    how.say(
        fmt::format("{} runs are to be made: each line of {} is one; then call billet study again",
                    lines.size(), list.string()));
    return;
  }
  how.say(fmt::format("{} runs go to Slurm", lines.size()));
  run_by_slurm(list, lines.size(), study.engine, how.stopped);
}

/// Names that no run will have are told before the runs are made.
void require_names(const std::string& expression, const std::vector<PlannedRun>& runs) {
  std::string mistake;
  for (const PlannedRun& run : runs)
    if (run.refused.empty()) {
      mistake = Expression::mistake_in(expression, run.columns);
      if (mistake.empty())
        return;
    }
  if (!mistake.empty())
    throw Error(Fault::case_file, "", mistake);
}

std::vector<std::string> read_off(const Study& study) {
  std::vector<std::string> expressions;
  for (const Quantity& quantity : study.quantities)
    if (quantity.expression.empty()) {
      expressions.push_back(quantity.of);
      expressions.push_back(quantity.over);
    }
  return expressions;
}

} // namespace

std::vector<PlannedRun> make_runs_of(const Study& study,
                                     const std::vector<Row>& rows,
                                     const std::vector<std::string>& read_off,
                                     const Conduct& how) {
  std::vector<PlannedRun> runs;
  runs.reserve(rows.size());
  for (const Row& row : rows) {
    if (how.stopped()) // many rows take long to be read
      runs.push_back({.refused = "the study was stopped before"});
    else
      runs.push_back(plan_run(study, row, how.folder / "runs", how.program));
  }
  for (const std::string& expression : read_off)
    require_names(expression, runs);
  const std::vector<Pending> pending = pending_of(runs, how.again);
  how.say(fmt::format("{} rows, {} runs to be made", rows.size(), pending.size()));
  make_runs(study, rows, pending, how);
  return runs;
}

Conducted conduct(const Study& study, const Conduct& how) {
  io::make_folder(how.folder);
  const io::FolderLock lock(how.folder);
  const std::vector<Row> rows = rows_of(study);
  const std::vector<PlannedRun> runs = make_runs_of(study, rows, read_off(study), how);
  Conducted result;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    result.rows.push_back(outcome_of(study, rows[r], runs[r]));
    result.n_left += result.rows.back().end ? 0 : 1;
  }
  std::vector<FurtherColumn> further;
  if (result.n_left == 0) {
    result.findings = findings_of(study, result.rows);
    if (result.findings.trade)
      further.push_back({"error", result.findings.trade->errors});
    io::write_file(how.folder / "study.md", in_words(study, result.findings));
    io::write_file(how.folder / "study.json", json_text(study, result.rows, result.findings));
  }
  io::write_file(how.folder / "study.csv", csv_text(study, result.rows, further));
  return result;
}

} // namespace billet::study
