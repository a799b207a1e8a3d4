// The program: finds the command, catches what goes wrong, gives the exit status.

#include "app/among_processes.h"
#include "app/command_line.h"
#include "app/no_memory.h"
#include "app/processor.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/results/vtk_threads.h"
#include "mechanics/linear/blas.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

namespace {

using billet::Error;
using billet::Fault;
namespace app = billet::app;

constexpr int internal_error = 70;

/// Opens /dev/null for standard streams that are closed, so that no file of ours takes their
/// numbers. Nothing can be written to a standard output that was closed; this is reported at the
/// end.
void open_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 &&
        open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR) < 0)
      std::exit(internal_error);
}

/// Lets the C library keep what is freed: factorizations take and give back the same megabytes in
/// each iteration, and asking the system for them anew costs a tenth to a fifth of a run.
void keep_freed_memory() {
  constexpr int largest_kept = 32 << 20; // larger blocks go back to the system, as ever [bytes]
  constexpr int most_kept = 512 << 20;   // at the end of the heap [bytes]
  mallopt(M_MMAP_THRESHOLD, largest_kept);
  mallopt(M_TRIM_THRESHOLD, most_kept);
}

const app::Command& find_command(const std::string& name) {
  std::vector<std::string> known;
  for (const app::Command& command : app::commands()) {
    if (command.name == name)
      return command;
    known.emplace_back(command.name);
  }
  throw Error(Fault::usage, "", "unknown command '" + name + "'",
              billet::io::suggestion(name, known));
}

int run(const std::vector<std::string>& words) {
  if (words.empty())
    throw Error(Fault::usage, "", "a command is missing", "'billet --help' lists the commands");
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    fmt::print("{}", app::help());
    return 0;
  }
  if (words[0] == "--version") {
    fmt::print("billet {}\n", BILLET_VERSION);
    return 0;
  }
  const app::Command& command = find_command(words[0]);
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  for (const std::string& word : rest)
    if (word == "--help" || word == "-h") {
      fmt::print("{}", app::help(command));
      return 0;
    }
  return command.run(app::parse(command, rest));
}

int report(int status, const std::string& text) {
  std::fflush(stdout);
  // Nothing is left to be done if this fails; the status says enough.
  std::fputs(("billet: " + text + "\n").c_str(), stderr);
  return status;
}

/// The status of a command whose answer may not have reached standard output.
int after_output(int status) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
    return status;
  return report(status != 0 ? status : static_cast<int>(Fault::input_output),
                fmt::format("standard output cannot be written: {} [not-written]",
                            errno != 0 ? std::strerror(errno) : "unknown reason"));
}

/// All of it, in one process.
int program(int argc, char** argv) {
  open_streams();
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of writing
  keep_freed_memory();
  billet::mechanics::set_blas_threads(1);
  billet::mechanics::flush_subnormal_numbers();
  billet::io::keep_vtk_to_one_thread();
  try {
    return after_output(run(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const Error& error) {
    return report(static_cast<int>(error.fault()), error.what());
  } catch (const std::bad_alloc&) {
    return app::report_no_memory();
  } catch (const std::system_error& error) { // of std::filesystem and of output
    if (error.code() == std::errc::not_enough_memory)
      return app::report_no_memory();
    if (std::ferror(stdout) != 0)
      return report(static_cast<int>(Fault::input_output),
                    fmt::format("standard output cannot be written: {} [not-written]",
                                error.code().message()));
    return report(static_cast<int>(Fault::input_output), fmt::format("{} [file]", error.what()));
  } catch (const std::exception& error) {
    return report(internal_error, fmt::format("internal error: {} [exit-70]", error.what()));
  }
}

} // namespace

int main(int argc, char** argv) {
  app::go_on_for_this_processor(argv);
  return app::among_processes(argc, argv, &program);
}
