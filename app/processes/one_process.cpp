// billet: one process.

#include "app/among_processes.h"
#include "app/processes/launcher.h"
#include "geometry/base/error.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace billet::app {

namespace {

/// Whether the parent was started by mpiexec as well: then it, not mpiexec, has started this
/// process, a script of one of several processes say.
bool parent_was_launched() {
  std::ifstream stream("/proc/" + std::to_string(::getppid()) + "/environ", std::ios::binary);
  const std::string variables = '\0' + std::string(std::istreambuf_iterator<char>(stream), {});
  for (const std::string_view name : {"OMPI_COMM_WORLD_SIZE=", "PMI_SIZE="})
    if (variables.find('\0' + std::string(name)) != std::string::npos)
      return true;
  return false;
}

/// Whether several processes would write the same files.
bool writes_results(std::string_view command) {
  return command == "run" || command == "study" || command == "chart";
}

} // namespace

/// Several would all run the same case, and write the same files.
int among_processes(int argc, char** argv, int (*program)(int, char**)) {
  const bool writes = argc > 1 && writes_results(argv[1]);
  if (!writes || launched_processes() <= 1 || parent_was_launched())
    return program(argc, argv);
  if (launched_as() == 0)
    std::fputs("billet: mpiexec has started several processes, and this program runs in one; "
               "billet-mpi runs in several (./dev build --mpi builds it) [usage]\n",
               stderr);
  return static_cast<int>(Fault::usage);
}

} // namespace billet::app
