// In how many processes the program runs: `billet` in one, `billet-mpi` in as many as mpiexec
// starts.

#pragma once

namespace billet::app {

/// Calls the program in this process, or makes this process serve another one that does. Each of
/// the two programs has its own.
///
/// @return exit status
[[nodiscard]] int among_processes(int argc, char** argv, int (*program)(int, char**));

} // namespace billet::app
