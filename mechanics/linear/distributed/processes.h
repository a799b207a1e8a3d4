// The processes that the program runs in, where it was started as several (mpiexec).
//
// Process 0 runs the program; the others serve its linear systems. MPI and PETSc are in a component
// that is loaded (component.h), which not every installation has. The state is that of the program
// as a whole, as MPI's is.

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/linear/distributed/component.h"

#include <vector>

namespace billet::mechanics {

/// Loads the component and starts MPI. Called once, first of all.
///
/// @return the number of this process, or why it cannot be one of several
[[nodiscard]] Outcome<int> start_processes();

/// What a process other than 0 does until process 0 ends. @return exit status
[[nodiscard]] int serve_processes();

/// Process 0: ends the others. Nothing is left to be solved.
void end_processes();

/// 1 where they were not started.
[[nodiscard]] int number_of_processes();

/// @pre number_of_processes() > 1
[[nodiscard]] const DistributedComponent& distributed_component();

/// Memory that the processes have taken so far, shape (number_of_processes()); empty: there is one.
[[nodiscard]] std::vector<ProcessMemory> memory_of_processes();

} // namespace billet::mechanics
