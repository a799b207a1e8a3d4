// Factorization or multigrid by all processes, with GMRES around it by all of them too.
//
// Process 0 has the matrix; its rows are sent to those that own them whenever its values are new.

#pragma once

#include "mechanics/linear/distributed/component.h"
#include "mechanics/linear/distributed/node_parts.h"
#include "mechanics/linear/linear_solver.h"

#include <span>

namespace billet::mechanics {

class DistributedSolver final : public Factorization {
public:
  /// Whether systems of a pattern are solved by all processes.
  [[nodiscard]] static bool serves(const BlockPattern& pattern, SolverChoice choice);

  /// @pre number_of_processes() > 1; pattern outlives the solver
  explicit DistributedSolver(const BlockPattern& pattern);
  ~DistributedSolver() override;
  DistributedSolver(const DistributedSolver&) = delete;
  DistributedSolver& operator=(const DistributedSolver&) = delete;

  /// For the next factorization.
  void choose(DistributedMethod method) { method_ = method; }
  /// Matrices that come may have other values than those that were sent.
  void expect_new_values() { sent_ = nullptr; }

  void set_positions(std::span<const double> positions) override { positions_ = positions; }
  [[nodiscard]] bool factorize(const SparseMatrix& matrix) override;
  /// As exactly as GMRES can, for the matrix that was sent last.
  void solve(std::span<double> rhs) override;
  void release() override;
  [[nodiscard]] FactorCost cost() const override { return cost_; }
  [[nodiscard]] GmresReport iterate(Gmres& gmres,
                                    const SparseMatrix& matrix,
                                    std::span<const double> weights,
                                    std::span<const double> rhs,
                                    std::span<double> x,
                                    double tolerance,
                                    const Patience& patience,
                                    std::span<const std::vector<double>> known) override;

private:
  void send(const SparseMatrix& matrix);
  [[nodiscard]] GmresReport solve_sent(std::span<const double> weights,
                                       std::span<const double> rhs,
                                       std::span<double> x,
                                       double tolerance,
                                       int most) const;

  const BlockPattern* pattern_;
  const DistributedComponent* component_;
  NodeParts parts_;
  int system_ = -1; ///< its number; < 0: nothing has been sent
  DistributedMethod method_ = distributed_ldlt;
  std::span<const double> positions_;
  const SparseMatrix* sent_ = nullptr; ///< whose values the processes have
  FactorCost cost_;
};

} // namespace billet::mechanics
