// billet run: reads a case, runs it, writes its results.

#include "app/command_line.h"
#include "app/make_process.h"
#include "app/progress.h"
#include "app/start_note.h"
#include "app/stop_signals.h"
#include "app/threads.h"
#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/results/checkpoint.h"
#include "io/results/run_writer.h"
#include "mechanics/linear/blas.h"
#include "mechanics/linear/distributed/processes.h"
#include "process/loop/run_checks.h"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace billet::app {

namespace {

std::string ending(process::RunStatus status, bool usable) {
  switch (status) {
  case process::RunStatus::done:
    return usable ? "done" : "failed-checks";
  case process::RunStatus::not_converged:
    return "not-converged";
  case process::RunStatus::stopped:
    return "stopped";
  }
  return "";
}

int exit_status(process::RunStatus status, bool usable) {
  switch (status) {
  case process::RunStatus::done:
    return usable ? 0 : static_cast<int>(Fault::failed_check);
  case process::RunStatus::not_converged:
    return static_cast<int>(Fault::not_converged);
  case process::RunStatus::stopped:
    return 128 + stop_signal();
  }
  return 0;
}

std::string largest_in_words(const io::LargestForce& largest, const io::UnitSystem& units) {
  return fmt::format(" at the end, at most {:.6g} {} at time {:.6g} {}", largest.force.norm(),
                     units.force, largest.time, units.time);
}

void print_summary(const process::Run& run,
                   const io::Case& content,
                   const std::vector<io::LargestForce>& largest,
                   const io::RunEnd& end,
                   const std::filesystem::path& folder) {
  fmt::print("{}: {} at time {:.6g} {}, {} increment{}, {} iterations, {} cut-back{}\n",
             content.title.empty() ? "run" : content.title, end.status, run.state.time,
             content.units.time, run.state.increment, run.state.increment == 1 ? "" : "s",
             run.state.counters.iterations, run.state.counters.cutbacks,
             run.state.counters.cutbacks == 1 ? "" : "s");
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const Vec3& force = run.contact()->loads()[t].force;
    fmt::print("tool {}: force ({:.6g}, {:.6g}, {:.6g}) {}{}\n", run.tools()[t].name, force[0],
               force[1], force[2], content.units.force,
               t < largest.size() ? largest_in_words(largest[t], content.units) : "");
  }
  for (const process::BlowReport& blow : run.blows())
    fmt::print("blow of {}: energy {:.6g} {} {}, {:.1f} % used, stroke {:.6g} {} in {:.4g} {}\n",
               run.tools()[blow.tool].name, blow.energy + blow.driven, content.units.force,
               content.units.length, 100.0 * blow.used / (blow.energy + blow.driven), blow.stroke,
               content.units.length, blow.time - blow.begun, content.units.time);
  fmt::print("energy: external {:.6g}, elastic {:.6g}, plastic {:.6g}, friction {:.6g} {} {}; "
             "balance {:.2e}\n",
             run.state.energy.external, run.state.energy.elastic, run.state.energy.plastic,
             run.state.energy.friction, content.units.force, content.units.length,
             run.state.energy.error());
  fmt::print("results: {}\n", folder.string());
  if (end.exit_status == static_cast<int>(Fault::not_converged))
    fmt::print("what went wrong: {}\n", (folder / "failure" / "post_mortem.txt").string());
}

void print_profile(const process::Run& run) {
  const process::PhaseTimes& t = run.clock.times;
  const auto line = [&](std::string_view phase, double seconds) {
    fmt::print("{:<14} {:>9.3f} s {:>6.1f} %\n", phase, seconds, 100.0 * seconds / t.total);
  };
  line("search", t.search);
  line("contact", t.contact);
  line("elements", t.elements);
  line("assembly", t.assembly);
  line("analysis", t.analysis);
  line("factorization", t.factorization);
  line("solve", t.solve);
  line("certificate", t.certificate);
  line("output", t.output);
  if (run.scene.remesh)
    line("remeshing", t.remeshing);
  line("rest", t.rest());
  line("total", t.total);
  const mechanics::SolverWork& work = run.solver_work();
  fmt::print("{} linear systems: {} factorizations at {:.3g} GFLOP/s, {} substitutions, {} systems "
             "with an earlier factorization; the last factorization, {}, {:.3g} GFLOP, {:.3g} MB\n",
             work.systems, work.factorizations,
             work.factorization > 0.0 ? 1e-9 * work.flops / work.factorization : 0.0,
             work.substitutions, work.reused, work.last_method, 1e-9 * work.last_flops,
             1e-6 * work.last_factor_bytes);
}

/// The checkpoint that the command line asks for; none: the run begins at its start.
std::optional<io::FoundCheckpoint> wanted_checkpoint(const Arguments& arguments,
                                                     const std::filesystem::path& folder) {
  if (arguments.resume)
    return io::latest_checkpoint(folder);
  if (!arguments.from)
    return std::nullopt;
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(*arguments.from, error); // whatever its name
  const std::size_t at = is_folder ? std::string::npos : arguments.from->rfind('@');
  const std::filesystem::path results = arguments.from->substr(0, at);
  if (std::filesystem::equivalent(results, folder, error))
    throw Error(
        Fault::usage, "",
        fmt::format("--from {} and the results of this run are one folder", results.string()),
        "choose another folder with -o, or go on in this one with --resume");
  if (at == std::string::npos)
    return io::latest_checkpoint(results);
  const std::string text = arguments.from->substr(at + 1);
  double time = 0.0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (wrong != std::errc{} || end != text.data() + text.size())
    throw Error(Fault::usage, "",
                fmt::format("--from needs RESULTS or RESULTS@TIME, not '{}'", *arguments.from));
  return io::latest_checkpoint(results, time);
}

/// Refuses what cannot go on from a checkpoint with the same meaning.
void require_same(const io::FoundCheckpoint& found, const io::Case& content) {
  const io::Checkpoint& checkpoint = found.checkpoint;
  if (checkpoint.version != BILLET_VERSION)
    throw Error(
        Fault::input_output, found.file.string(),
        fmt::format("was written by billet {}, this is {}", checkpoint.version, BILLET_VERSION),
        "run the case from the start, or with that version");
  std::vector<Complaint> complaints;
  for (std::string& change :
       io::changes_of_case(checkpoint.content, io::resolved_toml(content), checkpoint.stage))
    complaints.push_back({found.file.string(), "the case has changed: " + change,
                          "a run may go on with another title, end of the run or of the present "
                          "stage, later stages, stop, output and solver.threads only"});
  if (!complaints.empty())
    throw Error(Fault::case_file, std::move(complaints));
}

void go_on_from(const io::FoundCheckpoint& found, process::Process& process) {
  if (io::scene_fingerprint(process.view().scene) != found.checkpoint.scene)
    throw Error(Fault::case_file, found.file.string(),
                "the mesh or a tool's surface is not that of the run so far: one of the files that "
                "the case names has changed",
                "bring the files back, or run the case from the start");
  process.resume(found.checkpoint.run);
}

} // namespace

int run_case(const Arguments& arguments) {
  const std::filesystem::path file = arguments.file;
  const io::Case content = io::read_case(file, arguments.overrides, {arguments.allow_outside});
  const std::string name = file_name(file, "case");
  const std::filesystem::path folder =
      arguments.output.value_or(std::filesystem::path("results") / name);
  const std::optional<io::FoundCheckpoint> found = wanted_checkpoint(arguments, folder);
  if (found)
    require_same(*found, content);
  const int available = oneapi::tbb::info::default_concurrency();
  const int threads = arguments.threads.value_or(content.solver.threads.value_or(available));
  limit_threads(threads);
  Progress progress(arguments.quiet, content.units);
  const ReadyProcess ready =
      make_process(content, arguments.file, [&](const std::string& line) { progress.say(line); });
  process::Process& process = *ready.process;
  const process::Run& run = process.view();
  if (found)
    go_on_from(*found, process);
  const int processes = mechanics::number_of_processes();
  progress.say(fmt::format("billet {}, {}{} thread(s), BLAS kernels {}", BILLET_VERSION,
                           processes > 1 ? fmt::format("{} processes, ", processes) : "", threads,
                           mechanics::blas_core()));
  for (const std::string& note : ready.notes)
    progress.say(note);
  std::vector<std::string> warnings;
  std::copy_if(ready.notes.begin(), ready.notes.end(), std::back_inserter(warnings),
               [](const std::string& note) { return note.starts_with("warning: "); });
  io::RunWriter writer(folder, name, content,
                       {BILLET_VERSION, mechanics::blas_core(), threads, std::move(warnings)},
                       {found ? &found->checkpoint : nullptr, arguments.resume});
  progress.write_to(folder / "run.log", writer.size_of_log());
  note_start(folder, threads, arguments.resume);
  if (found)
    progress.say_aside(fmt::format("goes on from {} at time {:.6g} {}, increment {}",
                                   found->file.string(), found->checkpoint.time, content.units.time,
                                   found->checkpoint.increment));
  if (found)
    for (const std::string& note : found->notes)
      progress.say_aside("warning: [checkpoint] " + note);
  const process::RunStatus status = process.run({&writer, &progress});
  for (const std::string& line : writer.advice(run))
    progress.insist("what may help: " + line);
  std::vector<std::string> of_run = writer.warnings(run);
  for (const std::string& warning : of_run)
    progress.say(warning);
  const std::vector<process::FailedCheck> failed =
      status == process::RunStatus::stopped // it goes on
          ? std::vector<process::FailedCheck>()
          : process::failed_checks(run);
  for (const process::FailedCheck& check : failed)
    progress.insist(fmt::format("failed check '{}': {}", check.name, check.what));
  const io::RunEnd end{ending(status, failed.empty()), exit_status(status, failed.empty()), failed};
  writer.write_summary(run, end, std::move(of_run));
  print_summary(run, content, writer.largest_forces(), end, folder);
  if (arguments.profile)
    print_profile(run);
  return end.exit_status;
}

} // namespace billet::app
