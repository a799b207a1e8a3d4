#include "mechanics/linear/distributed/petsc_preconditioner.h"

#include <petscksp.h>

#include <algorithm>

namespace billet::mechanics {

namespace {

constexpr PetscErrorCode good = 0;

/// Numbers of MUMPS' manual.
namespace mumps {
constexpr PetscInt scaling = 8, ordering = 7, room = 14, null_pivots = 24;
constexpr PetscInt metis = 5, none = 0, per_cent = 30;
constexpr PetscInt status = 1, entries = 29, flops = 3;
constexpr PetscInt too_small = -9, too_small_integers = -8, no_memory = -13, no_integers = -7;
} // namespace mumps

PetscErrorCode set_modes(Mat matrix, Vec positions) {
  MatNullSpace modes = nullptr;
  PetscCall(MatNullSpaceCreateRigidBody(positions, &modes));
  PetscCall(MatSetNearNullSpace(matrix, modes));
  PetscCall(MatNullSpaceDestroy(&modes));
  return good;
}

PetscErrorCode entries_of_levels(PC cycle, Mat matrix, double& entries) {
  PetscReal grid = 1.0, operators = 1.0;
  MatInfo info{};
  PetscCall(PCMGGetGridComplexity(cycle, &grid, &operators));
  PetscCall(MatGetInfo(matrix, MAT_GLOBAL_SUM, &info));
  entries = operators * info.nz_used;
  return good;
}

} // namespace

void DistributedPreconditioner::clear() {
  static_cast<void>(PCDestroy(&cycle_));
  static_cast<void>(MatDestroy(&factor_));
  ready_ = false;
}

PetscErrorCode
DistributedPreconditioner::set_up(DistributedSetUp& set_up, Mat matrix, Vec positions) {
  ready_ = lacks_memory_ = false;
  if (set_up.method != method_ || set_up.method == distributed_multigrid)
    clear();
  method_ = set_up.method;
  if (method_ == distributed_multigrid)
    return set_up_multigrid(set_up, matrix, positions);
  return factorize(set_up, matrix);
}

PetscErrorCode
DistributedPreconditioner::set_up_multigrid(DistributedSetUp& set_up, Mat matrix, Vec positions) {
  PetscCall(set_modes(matrix, positions));
  PetscCall(PCCreate(PETSC_COMM_WORLD, &cycle_));
  PetscCall(PCSetOptionsPrefix(cycle_, "bmg_"));
  PetscCall(PCSetOperators(cycle_, matrix, matrix));
  PetscCall(PCSetFromOptions(cycle_));
  PetscCall(PCSetUp(cycle_));
  PCFailedReason failed = PC_NOERROR;
  PetscCall(PCGetFailedReason(cycle_, &failed));
  ready_ = failed == PC_NOERROR;
  return entries_of_levels(cycle_, matrix, set_up.entries);
}

PetscErrorCode DistributedPreconditioner::analyse(DistributedMethod method, Mat matrix) {
  const MatFactorType type = method == distributed_ldlt ? MAT_FACTOR_CHOLESKY : MAT_FACTOR_LU;
  const bool by_mumps = method != distributed_superlu;
  PetscCall(
      MatGetFactor(matrix, by_mumps ? MATSOLVERMUMPS : MATSOLVERSUPERLU_DIST, type, &factor_));
  if (by_mumps) {
    PetscCall(MatMumpsSetIcntl(factor_, mumps::ordering, mumps::metis));
    PetscCall(MatMumpsSetIcntl(factor_, mumps::scaling, mumps::none)); // all are displacements
    PetscCall(MatMumpsSetIcntl(factor_, mumps::room, mumps::per_cent));
    PetscCall(MatMumpsSetIcntl(factor_, mumps::null_pivots, mumps::none)); // an error, not a guess
  }
  MatFactorInfo info{};
  PetscCall(MatFactorInfoInitialize(&info));
  if (type == MAT_FACTOR_CHOLESKY)
    PetscCall(MatCholeskyFactorSymbolic(factor_, matrix, nullptr, &info));
  else
    PetscCall(MatLUFactorSymbolic(factor_, matrix, nullptr, nullptr, &info));
  return good;
}

PetscErrorCode DistributedPreconditioner::factorize_once(Mat matrix) {
  MatFactorInfo info{};
  PetscCall(MatFactorInfoInitialize(&info));
  if (method_ == distributed_ldlt)
    PetscCall(MatCholeskyFactorNumeric(factor_, matrix, &info));
  else
    PetscCall(MatLUFactorNumeric(factor_, matrix, &info));
  MatFactorError error = MAT_FACTOR_NOERROR;
  PetscCall(MatFactorGetError(factor_, &error));
  ready_ = error == MAT_FACTOR_NOERROR;
  return good;
}

PetscErrorCode DistributedPreconditioner::factorize(DistributedSetUp& set_up, Mat matrix) {
  if (factor_ == nullptr)
    PetscCall(analyse(method_, matrix));
  if (method_ != distributed_superlu)
    return factorize_by_mumps(set_up, matrix);
  MatInfo info{};
  PetscCall(MatGetInfo(matrix, MAT_GLOBAL_SUM, &info));
  set_up.entries = info.nz_used; // SuperLU_DIST does not tell of its factors
  return factorize_once(matrix);
}

/// Where pivoting finds too little room it gets twice as much.
PetscErrorCode DistributedPreconditioner::factorize_by_mumps(DistributedSetUp& set_up, Mat matrix) {
  constexpr int attempts = 5;
  PetscInt status = 0, entries = 0;
  for (PetscInt i = 0, room = mumps::per_cent; i < attempts; ++i) {
    PetscCall(factorize_once(matrix));
    PetscCall(MatMumpsGetInfog(factor_, mumps::status, &status));
    if (status != mumps::too_small && status != mumps::too_small_integers)
      break;
    PetscCall(MatMumpsSetIcntl(factor_, mumps::room, room *= 2));
  }
  lacks_memory_ = status == mumps::no_memory || status == mumps::no_integers;
  PetscCall(MatMumpsGetInfog(factor_, mumps::entries, &entries));
  PetscCall(MatMumpsGetRinfog(factor_, mumps::flops, &set_up.flops));
  constexpr double million = 1e6; // counted by millions, below zero, where the number does not fit
  set_up.entries = entries >= 0 ? entries : -million * static_cast<double>(entries);
  return good;
}

PetscErrorCode DistributedPreconditioner::apply(Vec in, Vec out) const {
  if (method_ == distributed_multigrid)
    PetscCall(PCApply(cycle_, in, out));
  else
    PetscCall(MatSolve(factor_, in, out));
  return good;
}

} // namespace billet::mechanics
