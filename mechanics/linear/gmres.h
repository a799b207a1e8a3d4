// Krylov solution of a linear system with the factorization of an earlier, similar matrix.
//
// While the contact set stays as it is the tangent changes little from one Newton iteration to the
// next: its last factorization brings the exact system's residual down by orders of magnitude in a
// few solves, each a small part of a new factorization. Flexible GMRES; Saad (1993).

#pragma once

#include "mechanics/linear/sparse_matrix.h"

#include <span>
#include <vector>

namespace billet::mechanics {

class Factorization;

/// How an iteration ended.
struct GmresReport {
  bool converged = false;
  int iterations = 0;
  int solves = 0;        ///< with the preconditioner
  double residual = 1.0; ///< relative [-]
};

/// How long an iteration is kept up.
struct Patience {
  int most = 0;       ///< iterations
  int first_look = 3; ///< iterations before it may be given up
  double gain = 1.0;  ///< factor by which its residual may yet fall faster than so far [-]
};

/// The iteration, with the memory it works in.
class Gmres {
public:
  /// Solves matrix * x = rhs from zero.
  ///
  /// Gives up as soon as the way the residual shrinks says that the most iterations will not do.
  ///
  /// @param preconditioner  holds a factorization of a matrix like this one
  /// @param weights         > 0: of each unknown's residual in the norm that is made small
  /// @param x               out: the solution; undefined unless the report says `converged`
  /// @param tolerance       relative residual to reach [-], > 0, in that norm
  /// @param known           directions to begin with, in place of preconditioned residuals
  [[nodiscard]] GmresReport solve(const SparseMatrix& matrix,
                                  Factorization& preconditioner,
                                  std::span<const double> weights,
                                  std::span<const double> rhs,
                                  std::span<double> x,
                                  double tolerance,
                                  const Patience& patience,
                                  std::span<const std::vector<double>> known = {});

private:
  using Vector = std::vector<double>;
  [[nodiscard]] double extend(int k);
  [[nodiscard]] double reduce(int k);
  void combine(int k, std::span<double> x) const;

  std::vector<Vector> basis_;      ///< orthonormal residuals
  std::vector<Vector> directions_; ///< preconditioned basis vectors
  std::vector<Vector> columns_;    ///< of the triangle of the least-squares problem
  Vector cosines_;
  Vector sines_;
  Vector projected_; ///< right-hand side of the least-squares problem
};

} // namespace billet::mechanics
