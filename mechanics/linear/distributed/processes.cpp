#include "mechanics/linear/distributed/processes.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cassert>
#include <cstdlib>

namespace billet::mechanics {

namespace {

constexpr const char* processes_file = "libbillet-mpi.so";

/// What has been started.
struct Started {
  const DistributedComponent* component = nullptr;
  int processes = 1;
};

Started& started() {
  static Started of_program;
  return of_program;
}

Outcome<const DistributedComponent*> load_distributed() {
  // Deep: PETSc must find its own MPI and MUMPS, not the sequential ones of the program.
  void* library = dlopen(processes_file, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (library == nullptr) {
    const char* why = dlerror(); // NOLINT(concurrency-mt-unsafe)
    return Failure{fmt::format("the component for several processes is not there: {}", why)};
  }
  const auto entry = reinterpret_cast<DistributedEntry>(dlsym(library, distributed_entry));
  if (entry != nullptr && entry()->version == distributed_version)
    return entry();
  return Failure{fmt::format("{} belongs to another version", processes_file)};
}

} // namespace

Outcome<int> start_processes() {
  assert(started().component == nullptr);
  const Outcome<const DistributedComponent*> component = load_distributed();
  if (!component)
    return component.error();
  int number = 0;
  const int processes = (*component)->start(&number);
  if (processes < 1)
    return Failure{fmt::format("MPI does not start: {}", (*component)->reason())};
  started() = {*component, processes};
  return number;
}

int serve_processes() { return distributed_component().serve(); }

void end_processes() {
  if (started().component != nullptr)
    started().component->end();
  started() = {};
}

int number_of_processes() { return started().processes; }

const DistributedComponent& distributed_component() {
  assert(started().component != nullptr);
  return *started().component;
}

std::vector<ProcessMemory> memory_of_processes() {
  if (number_of_processes() == 1)
    return {};
  std::vector<ProcessMemory> memory(static_cast<std::size_t>(number_of_processes()));
  distributed_component().memory(memory.data());
  return memory;
}

} // namespace billet::mechanics
