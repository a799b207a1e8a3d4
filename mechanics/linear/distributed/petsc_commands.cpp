// The component for several processes: what process 0 asks for, and the others do with it.
//
// Process 0 sends a command to all, and all of them call the same function of a system. While there
// is nothing to do the others sleep, so that threads of process 0 have their cores. An error that
// not all processes can know of ends them all.

#include "mechanics/linear/distributed/component.h"
#include "mechanics/linear/distributed/petsc_system.h"

#include <petscsys.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <thread>

namespace billet::mechanics {

namespace {

constexpr PetscErrorCode good = 0;

enum class Order : int { make, destroy, set_values, set_up, solve, release, memory, end };

/// What process 0 sends to all.
struct Command {
  Order order;
  int system;
  DistributedMethod method;
  int most;
  double tolerance;
};

/// What this process has.
struct State {
  int rank = 0;
  int processes = 1;
  int made = 0; ///< systems so far
  std::map<int, std::unique_ptr<DistributedSystem>> systems;
  ProcessMemory memory{};
  std::string reason;
};

State& state() {
  static State of_process;
  return of_process;
}

/// Of this process, from the system's own account.
double memory_now(const char* which) {
  std::ifstream status("/proc/self/status");
  constexpr double kilobyte = 1024.0;
  for (std::string word; status >> word;)
    if (double number = 0.0; word == which && status >> number)
      return kilobyte * number;
  return 0.0;
}

void note(double& most) { most = std::max(most, memory_now("VmRSS:")); }

[[noreturn]] void end_all(int status, const char* what) {
  std::fprintf(stderr, "billet-mpi: process %d of %d: %s\n", state().rank, state().processes, what);
  MPI_Abort(PETSC_COMM_WORLD, status);
  std::abort(); // which MPI_Abort does not come back to
}

constexpr int limit = 7, internal_error = 70; ///< exit statuses of the program

/// The worst of what all processes have come to. One that failed where others did not, and wait for
/// it in PETSc, does not wait for ever.
int agreed(int status) {
  int all = status;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&status, &all, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD, &request);
  if (status == distributed_done) {
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    return all;
  }
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0 && std::chrono::steady_clock::now() > give_up)
      end_all(internal_error, state().reason.c_str());
  }
  return all;
}

int status_of(PetscErrorCode code) {
  if (code == good)
    return distributed_done;
  if (static_cast<int>(code) == PETSC_ERR_MEM)
    end_all(limit, "not enough memory for this case");
  const char* text = nullptr;
  char* where = nullptr;
  PetscErrorMessage(code, &text, &where);
  state().reason = std::string(text != nullptr ? text : "unknown") +
                   (where != nullptr && *where != '\0' ? ": " + std::string(where) : "");
  return distributed_failed;
}

/// What all processes do at the same time: a function that returns an error code of PETSc.
template <class Function> int together(const Function& function) {
  try {
    return agreed(status_of(function()));
  } catch (const std::bad_alloc&) {
    end_all(limit, "not enough memory for this case");
  }
}

Command receive(Command command) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&command, sizeof command, MPI_BYTE, 0, PETSC_COMM_WORLD, &request);
  if (state().rank == 0) {
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    return command;
  }
  constexpr std::chrono::microseconds shortest{20}, longest{500};
  auto nap = shortest;
  for (int done = 0; done == 0; nap = std::min(2 * nap, longest)) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0)
      std::this_thread::sleep_for(nap);
  }
  return command;
}

// --- what all processes do ------------------------------------------------------------------

int make_here(int system, const DistributedPattern* pattern) {
  return together([&] {
    auto& made = state().systems[system];
    made = std::make_unique<DistributedSystem>();
    return made->make(pattern);
  });
}

int set_values_here(int system, const double* values) {
  const int status = together([&] { return state().systems.at(system)->set_values(values); });
  note(state().memory.after_distribution);
  return status;
}

int set_up_here(int system, DistributedSetUp& set_up) {
  DistributedSystem& here = *state().systems.at(system);
  const int status = together([&] { return here.set_up(set_up); });
  note(state().memory.after_set_up);
  if (status != distributed_done || here.preconditioner().is_ready())
    return status;
  return here.preconditioner().lacks_memory() ? distributed_no_memory : distributed_failed;
}

int solve_here(int system, DistributedSolve& solve) {
  const int status = together([&] { return state().systems.at(system)->solve(solve); });
  note(state().memory.after_solve);
  return status;
}

void gather_memory_here(ProcessMemory* of_processes) {
  state().memory.peak = memory_now("VmHWM:");
  constexpr int numbers = sizeof(ProcessMemory) / sizeof(double);
  MPI_Gather(&state().memory, numbers, MPI_DOUBLE, of_processes, numbers, MPI_DOUBLE, 0,
             PETSC_COMM_WORLD);
}

void end_here() {
  state().systems.clear();
  PetscFinalize();
  MPI_Finalize();
}

/// In a process other than 0.
void obey(const Command& command) {
  switch (command.order) {
  case Order::make:
    make_here(command.system, nullptr);
    break;
  case Order::destroy:
    state().systems.erase(command.system);
    break;
  case Order::set_values:
    set_values_here(command.system, nullptr);
    break;
  case Order::set_up: {
    DistributedSetUp set_up{command.method, nullptr, 0.0, 0.0};
    set_up_here(command.system, set_up);
    break;
  }
  case Order::solve: {
    DistributedSolve solve{};
    solve.tolerance = command.tolerance;
    solve.most = command.most;
    solve_here(command.system, solve);
    break;
  }
  case Order::release:
    state().systems.at(command.system)->release();
    break;
  case Order::memory:
    gather_memory_here(nullptr);
    break;
  case Order::end:
    break;
  }
}

// --- what process 0 asks for ----------------------------------------------------------------

void order(Order order, int system = 0) { receive({order, system, distributed_ldlt, 0, 0.0}); }

int make(const DistributedPattern* pattern) {
  const int system = state().made++;
  order(Order::make, system);
  return make_here(system, pattern) == distributed_done ? system : -1;
}

void destroy(int system) {
  order(Order::destroy, system);
  state().systems.erase(system);
}

int set_values(int system, const double* values) {
  order(Order::set_values, system);
  return set_values_here(system, values);
}

int set_up(int system, DistributedSetUp* request) {
  receive({Order::set_up, system, request->method, 0, 0.0});
  return set_up_here(system, *request);
}

int solve(int system, DistributedSolve* request) {
  receive({Order::solve, system, distributed_ldlt, request->most, request->tolerance});
  return solve_here(system, *request);
}

void release(int system) {
  order(Order::release, system);
  state().systems.at(system)->release();
}

void memory(ProcessMemory* of_processes) {
  order(Order::memory);
  gather_memory_here(of_processes);
}

void end() {
  order(Order::end);
  end_here();
}

const char* reason() { return state().reason.c_str(); }

PetscErrorCode start_petsc() {
  const char* const options[] = {
      "-bmg_pc_type",
      "gamg", //
      "-bmg_pc_gamg_type",
      "agg", //
      "-bmg_mg_levels_ksp_type",
      "chebyshev", //
      "-bmg_mg_levels_pc_type",
      "jacobi", //
      "-bmg_mg_levels_ksp_max_it",
      "2",
  };
  PetscCall(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
  PetscCall(PetscInitializeNoArguments());
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  for (std::size_t i = 0; i < std::size(options); i += 2)
    PetscCall(PetscOptionsSetValue(nullptr, options[i], options[i + 1]));
  return good;
}

int start(int* number_of_this_process) {
  int given = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS) {
    state().reason = "MPI_Init_thread failed";
    return 0;
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &state().rank);
  MPI_Comm_size(MPI_COMM_WORLD, &state().processes);
  *number_of_this_process = state().rank;
  if (status_of(start_petsc()) != distributed_done)
    return 0;
  return state().processes;
}

int serve() {
  for (Command command{}; command.order != Order::end;) {
    command = receive({});
    obey(command);
  }
  end_here();
  return 0;
}

} // namespace

extern "C" [[gnu::visibility("default")]] const DistributedComponent*
billet_distributed_component() {
  static const DistributedComponent component{
      distributed_version, start,  serve, end,     make,   destroy,
      set_values,          set_up, solve, release, memory, reason};
  return &component;
}

} // namespace billet::mechanics
