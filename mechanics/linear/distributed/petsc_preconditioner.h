// What GMRES is preconditioned with: one cycle of multigrid, or a factorization. By all processes.

#pragma once

#include "mechanics/linear/distributed/component.h"

#include <petscpc.h>

namespace billet::mechanics {

class DistributedPreconditioner {
public:
  DistributedPreconditioner() = default;
  ~DistributedPreconditioner() { clear(); }
  DistributedPreconditioner(const DistributedPreconditioner&) = delete;
  DistributedPreconditioner& operator=(const DistributedPreconditioner&) = delete;

  /// Multigrid smooths on the finest level with the values that the matrix has at the time; a
  /// factorization knows those it has been made of.
  ///
  /// @param positions  of the unknowns, for multigrid
  PetscErrorCode set_up(DistributedSetUp& set_up, Mat matrix, Vec positions);
  PetscErrorCode apply(Vec in, Vec out) const;
  void clear();

  /// Whether the last set-up can be applied; a singular matrix has none.
  [[nodiscard]] bool is_ready() const { return ready_; }
  /// Whether it failed for want of memory.
  [[nodiscard]] bool lacks_memory() const { return lacks_memory_; }

private:
  PetscErrorCode set_up_multigrid(DistributedSetUp& set_up, Mat matrix, Vec positions);
  PetscErrorCode factorize(DistributedSetUp& set_up, Mat matrix);
  PetscErrorCode analyse(DistributedMethod method, Mat matrix);
  PetscErrorCode factorize_once(Mat matrix);
  PetscErrorCode factorize_by_mumps(DistributedSetUp& set_up, Mat matrix);

  DistributedMethod method_ = distributed_multigrid;
  PC cycle_ = nullptr;
  Mat factor_ = nullptr; ///< with its analysis, while the method stays
  bool ready_ = false;
  bool lacks_memory_ = false;
};

} // namespace billet::mechanics
