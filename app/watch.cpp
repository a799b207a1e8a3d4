// billet watch: how a run is going on, seen from another terminal.

#include "app/command_line.h"
#include "app/watch_text.h"
#include "geometry/base/error.h"
#include "io/text/home_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

namespace billet::app {

namespace {

namespace fs = std::filesystem;
using report::ResultsFolder;
using report::RunState;

/// What changes as a run goes on; equal: there is nothing new to be read.
std::uintmax_t state_of_files(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const char* file : {"history.csv", "run.log", "summary.json", "remesh.csv"}) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(folder / file, error);
    sum = 31 * sum + (error ? 0 : size + 1);
  }
  return sum;
}

/// Of a run that was killed nothing is known; it is what a shell says of kill -9.
int status_of(const ResultsFolder& results, bool once) {
  constexpr int killed = 137;
  if (results.state == RunState::running)
    return once ? 0 : killed;
  return results.exit_status().value_or(killed);
}

/// Writes over what was shown before.
class Screen {
public:
  void show(const std::string& text) {
    if (n_lines_ > 0)
      fmt::print("\033[{}A", n_lines_);
    n_lines_ = 0;
    for (std::size_t at = 0; at < text.size(); ++n_lines_) {
      const std::size_t end = text.find('\n', at);
      fmt::print("{}\033[K\n", text.substr(at, end - at));
      at = end == std::string::npos ? text.size() : end + 1;
    }
    fmt::print("\033[J");
    std::fflush(stdout);
  }

private:
  int n_lines_ = 0;
};

/// For pipes and files: a line as often as the run has got on, all of it at the end.
void print_line(const ResultsFolder& results) {
  fmt::print("{}", results.state == RunState::running ? watch_line(results) + "\n"
                                                      : watch_text(results, 100));
  std::fflush(stdout);
}

} // namespace

int watch_results(const Arguments& arguments) {
  const fs::path folder = io::with_home_folder(arguments.file, "RESULTS");
  const bool terminal = ::isatty(STDOUT_FILENO) != 0;
  if (arguments.once) {
    const ResultsFolder results = report::read_results(folder);
    fmt::print("{}", watch_text(results, terminal ? terminal_columns(STDOUT_FILENO) : 100));
    return status_of(results, true);
  }
  Screen screen;
  std::optional<std::uintmax_t> seen;
  for (;;) {
    const std::uintmax_t state = state_of_files(folder);
    const bool is_new = state != seen;
    seen = state;
    const ResultsFolder results = report::read_results(folder);
    const bool goes_on = results.state == RunState::running;
    if (terminal)
      screen.show(watch_text(results, terminal_columns(STDOUT_FILENO)));
    else if (is_new || !goes_on)
      print_line(results);
    if (!goes_on)
      return status_of(results, false);
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

} // namespace billet::app
