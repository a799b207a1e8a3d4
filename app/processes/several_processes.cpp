// billet-mpi: as many processes as mpiexec starts. Process 0 runs the program, the others solve
// linear systems with it.

#include "app/among_processes.h"
#include "app/processes/launcher.h"
#include "geometry/base/error.h"
#include "mechanics/linear/distributed/processes.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <string>
#include <string_view>

namespace billet::app {

namespace {

int refuse(const std::string& text) {
  std::fputs(("billet-mpi: " + text + " [usage]\n").c_str(), stderr);
  return static_cast<int>(Fault::usage);
}

/// Whether all processes were started, and MPI sees one: it is another MPI than the launcher's.
bool is_cut_off(int processes) {
  return processes == 1 && (launched_processes() > 1 || launched_as() > 0);
}

/// Whether a command has a use for several processes, or takes no time.
bool may_be_several(std::string_view command) {
  return command == "run" || command == "check" || command == "help" || command.starts_with("-");
}

/// Process 0 ends the others; they let it end in order.
void leave_signals_to_the_first() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
    std::signal(number, SIG_IGN);
}

} // namespace

int among_processes(int argc, char** argv, int (*program)(int, char**)) {
  const Outcome<int> number = mechanics::start_processes();
  if (!number)
    return refuse(number.error().reason);
  const int processes = mechanics::number_of_processes();
  if (is_cut_off(processes))
    return launched_as() > 0
               ? static_cast<int>(Fault::usage)
               : refuse(
                     "the processes do not find each other: they were started by another MPI than "
                     "that of billet-mpi; start them by the mpiexec of its MPI (mpiexec.openmpi)");
  if (*number > 0) {
    leave_signals_to_the_first();
    return mechanics::serve_processes();
  }
  const std::string command = argc > 1 ? argv[1] : "";
  const int status =
      processes > 1 && argc > 1 && !may_be_several(command)
          ? refuse(fmt::format("'{}' is for one process: billet {}", command, command))
          : program(argc, argv);
  mechanics::end_processes();
  return status;
}

} // namespace billet::app
