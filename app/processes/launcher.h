// What has started this process: mpiexec tells by variables of the environment.

#pragma once

#include <cstdlib>
#include <string>

namespace billet::app {

/// The number that the first of these variables has; 0: none has one.
template <class... Names> [[nodiscard]] int number_in_environment(Names... names) {
  for (const char* name : {names...})
    if (const char* text = std::getenv(name); text != nullptr && *text != '\0')
      return std::atoi(text); // 0 where it is no number
  return 0;
}

/// Processes that mpiexec of Open MPI, MPICH or Intel MPI has started; 0: it has not.
[[nodiscard]] inline int launched_processes() {
  return number_in_environment("OMPI_COMM_WORLD_SIZE", "PMI_SIZE");
}

/// The number of this process among those; 0 for the first, and where there are none.
[[nodiscard]] inline int launched_as() {
  return number_in_environment("OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID");
}

} // namespace billet::app
