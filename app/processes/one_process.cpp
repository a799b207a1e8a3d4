// billet: one process.

#include "app/among_processes.h"
#include "app/processes/launcher.h"
#include "geometry/base/error.h"

#include <cstdio>

namespace billet::app {

/// Several would all run the same case, and write the same files.
int among_processes(int argc, char** argv, int (*program)(int, char**)) {
  if (launched_processes() <= 1)
    return program(argc, argv);
  if (launched_as() == 0)
    std::fputs("billet: mpiexec has started several processes, and this program runs in one; "
               "billet-mpi runs in several (./dev build --mpi builds it)\n",
               stderr);
  return static_cast<int>(Fault::usage);
}

} // namespace billet::app
