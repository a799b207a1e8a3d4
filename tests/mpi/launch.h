// Starts billet-mpi by mpiexec, on a machine that may have fewer cores than there are processes.

#pragma once

#include "tests/support/program.h"

#include <sys/types.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace billet::test {

/// What mpiexec of Open MPI asks for where root starts it, or more processes than there are cores;
/// others do not know these variables.
inline void allow_any_number_of_processes() {
  for (const auto& [name, value] :
       {std::pair{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, std::pair{"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
        std::pair{"OMPI_MCA_rmaps_base_oversubscribe", "1"},
        std::pair{"OMPI_MCA_hwloc_base_binding_policy", "none"}})
    ::setenv(name, value, 1);
}

/// The words after "mpiexec" are -n, their number, the program, and those given.
inline Start launched(int processes,
                      const std::vector<std::string>& words,
                      const std::filesystem::path& folder) {
  std::vector<std::string> all{"-n", std::to_string(processes), BILLET_MPI_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return {all, folder, &allow_any_number_of_processes, BILLET_MPIEXEC};
}

inline Outcome
launch(int processes, const std::vector<std::string>& words, const std::filesystem::path& folder) {
  return Program(launched(processes, words, folder)).end();
}

/// Processes that mpiexec has started in a folder, by the number that it gave them.
inline std::vector<pid_t> processes_with_rank(int rank, const std::filesystem::path& folder) {
  std::vector<pid_t> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0 || std::filesystem::read_symlink(entry.path() / "cwd", error) != folder || error)
      continue;
    const std::string environment = '\0' + whole_file(entry.path() / "environ");
    for (const std::string name : {"OMPI_COMM_WORLD_RANK=", "PMI_RANK="})
      if (environment.find('\0' + name + std::to_string(rank) + '\0') != std::string::npos)
        found.push_back(pid);
  }
  return found;
}

} // namespace billet::test
