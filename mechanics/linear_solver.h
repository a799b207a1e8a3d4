// Solution of the linear systems of Newton's method by direct factorization.
//
// The unknowns are ordered once per mesh (METIS on the node graph). A symmetric matrix goes to
// CHOLMOD's supernodal Cholesky factorization and, when a pivot is not positive, to MUMPS' LDL^T;
// an unsymmetric one to MUMPS' LU; UMFPACK stands in when MUMPS fails. Every solution's residual
// is checked and refined once where it is too large.

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/gmres.h"
#include "mechanics/sparse_matrix.h"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace billet::mechanics {

/// Which factorization solves the systems.
enum class SolverChoice { automatic, cholmod, mumps, umfpack };

/// What the last solution did, for the log and the summary.
struct SolveReport {
  std::string_view method;      ///< "cholmod", "mumps-ldlt", "mumps-lu", "umfpack", "gmres"
  double relative_residual = 0; ///< of the linear system
};

/// Work of a factorization.
struct FactorCost {
  double flops = 0.0;   ///< floating-point operations
  double entries = 0.0; ///< of the factors
};

/// One factorization method over one pattern; a detail of linear_solver.cpp and its companions.
class Factorization {
public:
  virtual ~Factorization() = default;
  /// @return false when the matrix is singular (or not positive definite, for Cholesky)
  [[nodiscard]] virtual bool factorize(const SparseMatrix& matrix) = 0;
  /// Overwrites the right-hand side with the solution.
  virtual void solve(std::span<double> rhs) = 0;
  /// Work of the last factorization, as counted by the method.
  [[nodiscard]] virtual FactorCost cost() const = 0;
};

/// Fill-reducing order of the unknowns: new position i holds unknown order[i].
[[nodiscard]] std::vector<Index> fill_reducing_order(const BlockPattern& pattern);

[[nodiscard]] std::unique_ptr<Factorization> make_cholmod(const BlockPattern& pattern,
                                                          std::span<const Index> order);
/// @param symmetric  LDL^T of the lower triangle instead of LU
[[nodiscard]] std::unique_ptr<Factorization>
make_mumps(const BlockPattern& pattern, std::span<const Index> order, bool symmetric);
[[nodiscard]] std::unique_ptr<Factorization> make_umfpack(const BlockPattern& pattern,
                                                          std::span<const Index> order);

/// Chooses among the factorizations and keeps their analyses for the life of the pattern.
class LinearSolver {
public:
  /// @pre pattern outlives the solver
  LinearSolver(const BlockPattern& pattern, SolverChoice choice);

  /// Solves matrix * x = rhs; `symmetric` promises that the matrix is.
  ///
  /// @param tolerance  relative residual that will do [-]: where the last factorization reaches it
  ///                   with less work than a new one, none is made. 0: as exact as can be
  [[nodiscard]] Outcome<SolveReport> solve(const SparseMatrix& matrix,
                                           bool symmetric,
                                           std::span<const double> rhs,
                                           std::span<double> x,
                                           double tolerance = 0.0);

  /// Solves for another right-hand side, just after `solve` with the same matrix.
  [[nodiscard]] Outcome<SolveReport> solve_again(const SparseMatrix& matrix,
                                                 bool symmetric,
                                                 std::span<const double> rhs,
                                                 std::span<double> x,
                                                 double tolerance);

private:
  [[nodiscard]] Outcome<SolveReport> solve_with(Factorization& factorization,
                                                std::string_view method,
                                                const SparseMatrix& matrix,
                                                std::span<const double> rhs,
                                                std::span<double> x);
  [[nodiscard]] Outcome<SolveReport> back_substitute(Factorization& factorization,
                                                     std::string_view method,
                                                     const SparseMatrix& matrix,
                                                     std::span<const double> rhs,
                                                     std::span<double> x);
  [[nodiscard]] Outcome<SolveReport> factorize_and_solve(const SparseMatrix& matrix,
                                                         bool symmetric,
                                                         std::span<const double> rhs,
                                                         std::span<double> x);

  const BlockPattern* pattern_;
  SolverChoice choice_;
  std::vector<Index> order_;
  std::unique_ptr<Factorization> cholmod_;
  std::unique_ptr<Factorization> mumps_symmetric_;
  std::unique_ptr<Factorization> mumps_;
  std::unique_ptr<Factorization> umfpack_;
  Factorization* last_ = nullptr; ///< holds a factorization of an earlier matrix
  bool current_ = false;          ///< ... of the last matrix `solve` was given
  Gmres gmres_;
  std::vector<double> residual_;
};

} // namespace billet::mechanics
