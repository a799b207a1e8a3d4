// A distributed system of equations: its rows, what it is preconditioned with, and GMRES.
//
// GMRES is preconditioned from the right, and residuals are weighed from the left, as in the
// program's own (gmres.h), which is flexible and keeps two bases; this one keeps one.

#pragma once

#include "mechanics/linear/distributed/petsc_preconditioner.h"
#include "mechanics/linear/distributed/petsc_rows.h"

#include <petscksp.h>

namespace billet::mechanics {

class DistributedSystem {
public:
  DistributedSystem() = default;
  ~DistributedSystem();
  DistributedSystem(const DistributedSystem&) = delete;
  DistributedSystem& operator=(const DistributedSystem&) = delete;

  PetscErrorCode make(const DistributedPattern* pattern);
  PetscErrorCode set_values(const double* values) { return rows_.fill(matrix_, values); }
  PetscErrorCode set_up(DistributedSetUp& set_up);
  PetscErrorCode solve(DistributedSolve& solve);
  void release() { preconditioner_.clear(); }
  [[nodiscard]] const DistributedPreconditioner& preconditioner() const { return preconditioner_; }

private:
  PetscErrorCode make_gmres();
  static PetscErrorCode multiply(Mat shell, Vec x, Vec y);
  static PetscErrorCode precondition(PC shell, Vec x, Vec y);

  DistributedRows rows_;
  DistributedPreconditioner preconditioner_;
  Mat matrix_ = nullptr;
  Mat weighed_ = nullptr; ///< weights times matrix
  KSP gmres_ = nullptr;
  Vec weights_ = nullptr;
  Vec work_ = nullptr;
  Vec rhs_ = nullptr;
  Vec x_ = nullptr;
};

} // namespace billet::mechanics
