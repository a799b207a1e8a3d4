#include "study/slurm_engine.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "study/file_text.h"
#include "study/local_engine.h"
#include "study/runs.h"

namespace billet::study {

namespace {

namespace fs = std::filesystem;

/// Slurm's own limit of an array, as it is configured by default.
constexpr std::size_t most_tasks = 1000;

/// The number of the job in what sbatch says, by itself or after words; empty: there is none.
std::string job_of(const std::string& said) {
  constexpr const char* digits = "0123456789";
  constexpr const char* words = "Submitted batch job ";
  const std::size_t at = said.find(words);
  const std::string rest = at != std::string::npos ? said.substr(at + std::strlen(words)) : said;
  return rest.substr(0, std::min(rest.find_first_not_of(digits), rest.size()));
}

/// Takes a job out of the queue; its runs store what they have.
void cancel(const std::string& job, const fs::path& output) {
  run_jobs(
      {{{"/usr/bin/env", "scancel", job}, output}}, 1, [] { return false; },
      [](std::size_t /*job*/, int /*status*/) {});
}

} // namespace

std::string slurm_script(const fs::path& list, std::size_t n_tasks) {
  return fmt::format("#!/bin/bash\n"
                     "awk -v first=\"$SLURM_ARRAY_TASK_ID\" 'NR % {0} == first % {0}' {1} |\n"
                     "  while IFS= read -r line; do bash -c \"$line\"; done\n",
                     n_tasks, quoted(fs::absolute(list).string()));
}

void run_by_slurm(const fs::path& list,
                  std::size_t n_lines,
                  const Engine& engine,
                  const std::function<bool()>& stopped) {
  const fs::path folder = list.parent_path(), script = folder / "slurm.sh",
                 output = folder / "slurm.txt";
  const std::size_t n_tasks = std::min(n_lines, most_tasks);
  io::write_file(script, slurm_script(list, n_tasks));
  const std::string at_once =
      engine.processes ? fmt::format("%{}", *engine.processes) : std::string();
  std::vector<std::string> command{"/usr/bin/env",
                                   "sbatch",
                                   "--wait",
                                   "--job-name=billet-study",
                                   fmt::format("--cpus-per-task={}", engine.threads),
                                   fmt::format("--array=1-{}{}", n_tasks, at_once),
                                   "--output=" + (fs::absolute(folder) / "slurm-%a.txt").string()};
  command.insert(command.end(), engine.options.begin(), engine.options.end());
  command.push_back(fs::absolute(script).string());
  int status = 0;
  run_jobs({{command, output}}, 1, stopped,
           [&](std::size_t /*job*/, int ended) { status = ended; });
  const std::string said = text_of_file(output);
  const std::string job = job_of(said);
  if (stopped()) {
    if (!job.empty())
      cancel(job, folder / "slurm-cancel.txt");
  } else if (status != 0 && job.empty()) {
    throw Error(Fault::input_output, output.string(),
                fmt::format("sbatch ended with status {}: {}", status, said),
                "give what your site asks for with [run] options = [...], or take engine = "
                "\"local\"");
  }
}

} // namespace billet::study
