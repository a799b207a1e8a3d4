#include "app/progress.h"

#include "app/progress_bar.h"
#include "app/stop_signals.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <utility>

namespace billet::app {

namespace {

/// Progress is a courtesy: a run goes on when nobody can be told.
void tell(const std::string& text) { std::fputs(text.c_str(), stderr); }

} // namespace

Progress::Progress(bool quiet, io::UnitSystem units)
    : quiet_(quiet), units_(std::move(units)), terminal_(isatty(STDERR_FILENO) != 0) {
  std::signal(SIGPIPE, SIG_IGN); // a reader of the progress that left does not end the run
}

bool Progress::stop_requested() const { return stop_signal() != 0; }

void Progress::write_to(std::filesystem::path file, std::optional<std::uintmax_t> goes_on) {
  notice_stop_signals(); // from now on there is something to lose
  path_ = std::move(file);
  std::error_code error;
  if (goes_on && std::filesystem::file_size(path_, error) >= *goes_on && !error) {
    std::filesystem::resize_file(path_, *goes_on, error);
    file_.open(path_, std::ios::app);
    log_.clear();
    return;
  }
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
    io::cannot_write(path_, errno);
}

void Progress::say(const std::string& line) {
  log(line + "\n");
  if (!quiet_ || line.starts_with("warning: "))
    tell(line + "\n");
}

void Progress::say_aside(const std::string& line) const {
  if (!quiet_ || line.starts_with("warning: "))
    tell(line + "\n");
}

void Progress::insist(const std::string& line) {
  log(line + "\n");
  tell(line + "\n");
}

void Progress::incremented(const process::Run& run, const process::IncrementReport& report) {
  const double end = run.scene.stages.back().end;
  std::string line =
      fmt::format("increment {:4d}  time {:.5g}/{:.5g}  iterations {:2d}  residual {:.1e}",
                  report.increment, report.time, end, report.iterations, report.residual);
  if (report.cutbacks > 0)
    line += fmt::format("  after {} cut-back(s)", report.cutbacks);
  if (run.contact() != nullptr)
    for (std::size_t t = 0; t < run.tools().size(); ++t)
      line +=
          fmt::format("  {} {:.5g}", run.tools()[t].name, run.contact()->loads()[t].force.norm());
  for (const std::string& event : report.events)
    line += "\n" + event;
  log(line + "\n");
  if (quiet_)
    return;
  if (terminal_)
    tell(fmt::format("\r{}\033[K", progress_bar(run, report, units_, terminal_columns())));
  else
    tell(line + "\n");
}

void Progress::failed(const process::Run&, const process::PostMortem& post) {
  if (terminal_ && !quiet_)
    tell("\n");
  insist(fmt::format(
      "billet: time {:.6g} could not be reached with increments down to {:.3g}: {} [exit-5]",
      post.time, post.dt, post.reason));
}

void Progress::remeshed(const process::Run&, const process::RemeshReport& r) {
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

void Progress::finished(const process::Run&) {
  if (terminal_ && !quiet_)
    tell("\n");
}

} // namespace billet::app
