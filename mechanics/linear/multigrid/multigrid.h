// Multigrid as what GMRES is preconditioned with, in the place of a factorization.
//
// One cycle of smoothed aggregation stands for a solution. PETSc does the work, in a component of
// its own (component.h), which not every installation has.

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/linear/linear_solver.h"

#include <memory>
#include <span>

namespace billet::mechanics {

struct MultigridComponent;

class Multigrid final : public Factorization {
public:
  /// @return  the reason if the component is not there or does not start
  [[nodiscard]] static Outcome<std::unique_ptr<Multigrid>> make();

  /// Whether the component is there, or several processes are, which have theirs.
  [[nodiscard]] static bool is_there();

  Multigrid(const MultigridComponent& component, void* multigrid);
  ~Multigrid() override;
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  void set_positions(std::span<const double> positions) override { positions_ = positions; }

  /// Sets the levels up. The finest matrix is not copied: cycles smooth with the values it has at
  /// the time, which may go on to change, and it has to stay where it is.
  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override;
  /// One cycle.
  void solve(std::span<double> rhs) override;
  void release() override;
  /// A set-up takes as long as some cycles, each of them a few products with all matrices.
  [[nodiscard]] FactorCost cost() const override;

private:
  const MultigridComponent* component_;
  void* multigrid_;
  std::span<const double> positions_;
  double entries_ = 0.0; ///< of all levels' matrices
};

} // namespace billet::mechanics
