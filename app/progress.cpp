#include "app/progress.h"

#include "app/progress_bar.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace billet::app {

namespace {

volatile std::sig_atomic_t caught = 0;

void on_signal(int number) { caught = number; }

/// Progress is a courtesy: a run goes on when nobody can be told.
void tell(const std::string& text) { std::fputs(text.c_str(), stderr); }

} // namespace

Progress::Progress(bool quiet, io::UnitSystem units)
    : quiet_(quiet), units_(std::move(units)), terminal_(isatty(STDERR_FILENO) != 0) {
  std::signal(SIGINT, &on_signal);
  std::signal(SIGTERM, &on_signal);
  std::signal(SIGPIPE, SIG_IGN); // a reader of the progress that left does not end the run
}

int Progress::signal() { return caught; }

bool Progress::stop_requested() const { return caught != 0; }

void Progress::write_to(std::filesystem::path file) {
  path_ = std::move(file);
  file_.open(path_, std::ios::trunc);
  log(std::exchange(log_, {}));
}

void Progress::log(const std::string& text) {
  if (path_.empty()) {
    log_ += text;
    return;
  }
  errno = 0;
  file_ << text << std::flush;
  if (!file_)
    throw Error(Fault::input_output, path_.string(),
                fmt::format("cannot be written: {}", std::strerror(errno)),
                "free some space, or choose another folder with -o");
}

void Progress::say(const std::string& line) {
  log(line + "\n");
  if (!quiet_ || line.starts_with("warning: ") || line.starts_with("failed check "))
    tell(line + "\n");
}

void Progress::incremented(const process::Process& process,
                           const process::IncrementReport& report) {
  const double end = process.scene().stages.back().end;
  std::string line =
      fmt::format("increment {:4d}  time {:.5g}/{:.5g}  iterations {:2d}  residual {:.1e}",
                  report.increment, report.time, end, report.iterations, report.residual);
  if (report.cutbacks > 0)
    line += fmt::format("  after {} cut-back(s)", report.cutbacks);
  if (process.contact() != nullptr)
    for (std::size_t t = 0; t < process.scene().tools.size(); ++t)
      line += fmt::format("  {} {:.5g}", process.scene().tools[t].name,
                          process.contact()->loads()[t].force.norm());
  for (const std::string& event : report.events)
    line += "\n" + event;
  log(line + "\n");
  if (quiet_)
    return;
  if (terminal_)
    tell(fmt::format("\r{}\033[K", progress_bar(process, report, units_, terminal_columns())));
  else
    tell(line + "\n");
}

void Progress::failed(const process::Process&, const process::PostMortem& post) {
  if (terminal_ && !quiet_)
    tell("\n");
  say(fmt::format("time {:.6g} could not be reached with increments down to {:.3g}: {}", post.time,
                  post.dt, post.reason));
}

void Progress::remeshed(const process::Process&, const process::RemeshReport& r) {
  const std::string line = fmt::format(
      "remeshing {} ({}): {} -> {} elements, quality {:.2g} -> {:.2g}, volume {:+.1e}, plastic "
      "work "
      "{:+.1e}, residual {:.1e}, force {:+.1e}, {:.2g} s",
      r.number, r.cause, r.elements[0], r.elements[1], r.quality.before, r.quality.after,
      r.volume.after / r.volume.before - 1.0,
      r.plastic_work.before > 0.0 ? r.plastic_work.after / r.plastic_work.before - 1.0 : 0.0,
      r.residual, r.force_jump(), r.seconds);
  log(line + "\n");
  if (!quiet_)
    tell((terminal_ ? "\r\033[K" : "") + line + "\n");
}

void Progress::finished(const process::Process&) {
  if (terminal_ && !quiet_)
    tell("\n");
}

} // namespace billet::app
