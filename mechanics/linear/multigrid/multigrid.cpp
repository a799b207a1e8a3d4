#include "mechanics/linear/multigrid/multigrid.h"

#include "mechanics/linear/distributed/processes.h"
#include "mechanics/linear/multigrid/component.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace billet::mechanics {

namespace {

constexpr const char* component_file = "libbillet-multigrid.so";

Outcome<const MultigridComponent*> load() {
  // Its BLAS is another than the program's, and would start threads of its own.
  setenv("OPENBLAS_NUM_THREADS", "1", 0); // NOLINT(concurrency-mt-unsafe): before its first use
  // In the folder of the program or library that this is part of, or where it was installed: their
  // run path.
  // Deep: PETSc must find its own MPI and MUMPS, not those of the program.
  void* library = dlopen(component_file, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (library == nullptr) {
    const char* why = dlerror(); // NOLINT(concurrency-mt-unsafe)
    return Failure{fmt::format("the multigrid component is not there: {}", why)};
  }
  const auto entry = reinterpret_cast<MultigridEntry>(dlsym(library, multigrid_entry));
  if (entry != nullptr && entry()->version == multigrid_version)
    return entry();
  return Failure{fmt::format("{} belongs to another version", component_file)};
}

/// Loaded when it is first asked for.
const Outcome<const MultigridComponent*>& component_of_process() {
  static const Outcome<const MultigridComponent*> component = load();
  return component;
}

} // namespace

bool Multigrid::is_there() { return number_of_processes() > 1 || bool(component_of_process()); }

Outcome<std::unique_ptr<Multigrid>> Multigrid::make() {
  const Outcome<const MultigridComponent*>& component = component_of_process();
  if (!component)
    return component.error();
  void* multigrid = (*component)->make();
  if (multigrid == nullptr)
    return Failure{fmt::format("multigrid does not start: {}", (*component)->reason())};
  return std::make_unique<Multigrid>(**component, multigrid);
}

Multigrid::Multigrid(const MultigridComponent& component, void* multigrid)
    : component_(&component), multigrid_(multigrid) {}

Multigrid::~Multigrid() { component_->destroy(multigrid_); }

bool Multigrid::factorize(const SparseMatrix& matrix) {
  const BlockPattern& pattern = *matrix.pattern;
  const MultigridSystem system{pattern.dim,
                               pattern.n_dofs(),
                               pattern.row_start.data(),
                               pattern.columns.data(),
                               const_cast<double*>(matrix.values.data()),
                               positions_.data()};
  entries_ = 0.0;
  if (component_->set_up(multigrid_, &system) != 0)
    return false;
  entries_ = static_cast<double>(pattern.n_entries()) + component_->entries(multigrid_);
  return true;
}

void Multigrid::solve(std::span<double> rhs) {
  if (component_->apply(multigrid_, rhs.data()) != 0)
    std::fill(rhs.begin(), rhs.end(), 0.0); // GMRES sees that it does not converge
}

void Multigrid::release() { component_->release(multigrid_); }

FactorCost Multigrid::cost() const {
  constexpr double cycles = 40.0, products = 8.0, per_entry = 2.0;
  return {cycles * products * per_entry * entries_, entries_, sizeof(double)};
}

} // namespace billet::mechanics
