// The multigrid component: smoothed aggregation by PETSc (GAMG), in this process alone.
//
// Vanek, Mandel, Brezina (1996); rigid-body modes of the present shape are what smoothing must not
// lose. Chebyshev polynomials around the diagonal smooth: unlike Gauss and Seidel's they bear rows
// of prescribed unknowns.

#include "mechanics/linear/multigrid/component.h"

#include <petscksp.h>

#include <iterator>
#include <string>

namespace billet::mechanics {

namespace {

constexpr PetscErrorCode good = 0;

std::string last_reason; ///< of the last failure

int failed(PetscErrorCode code) {
  const char* text = nullptr;
  char* where = nullptr;
  PetscErrorMessage(code, &text, &where);
  last_reason = std::string(text != nullptr ? text : "unknown") +
                (where != nullptr && *where != '\0' ? ": " + std::string(where) : "");
  return static_cast<int>(code);
}

/// Starts PETSc once; it stays to the end of the process.
PetscErrorCode start() {
  static bool started = false;
  if (started)
    return good;
  const char* const options[] = {
      "-bmg_pc_type",
      "gamg",
      "-bmg_pc_gamg_type",
      "agg",
      "-bmg_mg_levels_ksp_type",
      "chebyshev",
      "-bmg_mg_levels_pc_type",
      "jacobi",
      "-bmg_mg_levels_ksp_max_it",
      "2",
  };
  PetscCall(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
  PetscCall(PetscInitializeNoArguments());
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  for (std::size_t i = 0; i < std::size(options); i += 2)
    PetscCall(PetscOptionsSetValue(nullptr, options[i], options[i + 1]));
  started = true;
  return good;
}

class PetscMultigrid {
public:
  PetscMultigrid() = default;
  ~PetscMultigrid() { clear(); }
  PetscMultigrid(const PetscMultigrid&) = delete;
  PetscMultigrid& operator=(const PetscMultigrid&) = delete;

  PetscErrorCode set_up(const MultigridSystem& system) {
    clear();
    const PetscInt n = system.n_dofs;
    // The matrix stays where it is: PETSc promises to change nothing in arrays that it is lent.
    PetscCall(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, const_cast<int*>(system.row_start),
                                        const_cast<int*>(system.columns), system.values, &matrix_));
    PetscCall(MatSetBlockSize(matrix_, system.dim));
    PetscCall(set_modes(system));
    PetscCall(PCCreate(PETSC_COMM_SELF, &cycle_));
    PetscCall(PCSetOptionsPrefix(cycle_, "bmg_"));
    PetscCall(PCSetOperators(cycle_, matrix_, matrix_));
    PetscCall(PCSetFromOptions(cycle_));
    PetscCall(PCSetUp(cycle_));
    PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, system.dim, n, nullptr, &in_));
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &out_));
    return good;
  }

  PetscErrorCode apply(double* x) {
    PetscCall(VecPlaceArray(in_, x));
    PetscCall(PCApply(cycle_, in_, out_));
    PetscCall(VecCopy(out_, in_));
    PetscCall(VecResetArray(in_));
    return good;
  }

  [[nodiscard]] double entries() const {
    PetscReal grid = 1.0, operators = 1.0;
    MatInfo info{};
    if (cycle_ == nullptr || PCMGGetGridComplexity(cycle_, &grid, &operators) != good ||
        MatGetInfo(matrix_, MAT_LOCAL, &info) != good)
      return 0.0;
    return (operators - 1.0) * info.nz_used;
  }

  void clear() {
    static_cast<void>(PCDestroy(&cycle_));
    static_cast<void>(MatDestroy(&matrix_));
    static_cast<void>(VecDestroy(&in_));
    static_cast<void>(VecDestroy(&out_));
  }

private:
  PetscErrorCode set_modes(const MultigridSystem& system) {
    Vec positions = nullptr;
    PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, system.dim, system.n_dofs, system.positions,
                                    &positions));
    MatNullSpace modes = nullptr;
    PetscCall(MatNullSpaceCreateRigidBody(positions, &modes));
    PetscCall(MatSetNearNullSpace(matrix_, modes));
    PetscCall(MatNullSpaceDestroy(&modes));
    PetscCall(VecDestroy(&positions));
    return good;
  }

  Mat matrix_ = nullptr;
  PC cycle_ = nullptr;
  Vec in_ = nullptr;
  Vec out_ = nullptr;
};

PetscMultigrid& of(void* multigrid) { return *static_cast<PetscMultigrid*>(multigrid); }

void* make() {
  if (const PetscErrorCode code = start(); code != good) {
    failed(code);
    return nullptr;
  }
  return new PetscMultigrid;
}

int set_up(void* multigrid, const MultigridSystem* system) {
  const PetscErrorCode code = of(multigrid).set_up(*system);
  return code == good ? 0 : failed(code);
}

int apply(void* multigrid, double* x) {
  const PetscErrorCode code = of(multigrid).apply(x);
  return code == good ? 0 : failed(code);
}

void release(void* multigrid) { of(multigrid).clear(); }

void destroy(void* multigrid) { delete static_cast<PetscMultigrid*>(multigrid); }

const char* reason() { return last_reason.c_str(); }

double entries(const void* multigrid) {
  return static_cast<const PetscMultigrid*>(multigrid)->entries();
}

} // namespace

extern "C" [[gnu::visibility("default")]] const MultigridComponent* billet_multigrid_component() {
  static const MultigridComponent component{multigrid_version, make,    set_up, apply,
                                            release,           destroy, reason, entries};
  return &component;
}

} // namespace billet::mechanics
