// Solution of the linear systems of Newton's method by direct factorization.
//
// The unknowns are ordered once per mesh (METIS on the node graph). A symmetric matrix, or the
// symmetric neighbour of an unsymmetric one (SparseMatrix::unsymmetric), is factorized as L S L^T
// in single precision, with GMRES on the matrix itself around it. Where single precision loses a
// solution, CHOLMOD's supernodal Cholesky factorization in double precision stands in; where that
// meets a pivot that is not positive, or the neighbour is too far, MUMPS' LDL^T or LU: in large
// problems an LU in single precision, with GMRES around it. UMFPACK stands in when MUMPS fails.
// Large parts in space are solved by GMRES around multigrid where that is cheaper, or where memory
// does not hold the factors; what it does not solve is factorized. Where the program runs in
// several processes all of them solve large systems (distributed/). Every solution's residual is
// checked, and refined once where it is too large. docs/decisions/0010-symmetric-neighbour.md,
// 0013-memory-of-factorizations.md, 0018-factorization-in-single-precision.md, 0032-threads.md,
// 0033-multigrid.md, 0034-several-processes.md

#pragma once

#include "geometry/base/outcome.h"
#include "mechanics/linear/elimination.h"
#include "mechanics/linear/gmres.h"
#include "mechanics/linear/solver_settings.h"
#include "mechanics/linear/sparse_matrix.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace billet::mechanics {

/// What is asked of a solution.
struct SolveOptions {
  double tolerance = 0.0; ///< relative residual that will do [-]; 0: as exact as can be
  bool far = false;       ///< the matrix may have little in common with the last one
  std::span<const double> positions = {}; ///< of the nodes, shape (n_dofs): multigrid asks [mm]
};

/// What the last solution did, for the log and the summary.
struct SolveReport {
  std::string_view method;      ///< "ldlt-single", "cholmod", "cholmod-gmres", "mumps-ldlt",
                                ///< "mumps-lu-gmres" (in single precision), "mumps-lu", "umfpack",
                                ///< "multigrid"; in several processes "mumps-ldlt-gmres",
                                ///< "superlu-dist" as well;
                                ///< "gmres": with an earlier factorization
  double relative_residual = 0; ///< of the linear system
};

/// What solving has taken so far.
struct SolverWork {
  double analysis = 0.0;      ///< time for orders and symbolic factorizations [s]
  double factorization = 0.0; ///< time [s]
  double substitution = 0.0;  ///< time for substitutions and iterations around them [s]
  double flops = 0.0;         ///< of all factorizations
  long factorizations = 0;
  long substitutions = 0;
  long reused = 0;                ///< systems solved without a factorization of their own
  long nearly_symmetric = 0;      ///< unsymmetric systems solved with their symmetric part
  long multigrid = 0;             ///< systems solved around a set-up of multigrid of their own
  long multigrid_failed = 0;      ///< systems that it did not solve
  long systems = 0;               ///< however many right-hand sides each has
  std::string_view last_method;   ///< of the last factorization
  double last_flops = 0.0;        ///< of the last factorization
  double last_factor_bytes = 0.0; ///< of the last factorization's factors

  /// The same with the work of an earlier solver, on another pattern.
  [[nodiscard]] SolverWork after(const SolverWork& earlier) const;
};

/// Work of a factorization.
struct FactorCost {
  double flops = 0.0;                      ///< floating-point operations
  double entries = 0.0;                    ///< of the factors
  std::size_t entry_size = sizeof(double); ///< [byte]
};

/// One factorization method over one pattern, which outlives it; a detail of linear_solver.cpp and
/// its companions.
class Factorization {
public:
  virtual ~Factorization() = default;
  /// @return false when the matrix is singular (or not positive definite, for Cholesky)
  [[nodiscard]] virtual bool factorize(const SparseMatrix& matrix) = 0;
  /// Overwrites the right-hand side with the solution.
  virtual void solve(std::span<double> rhs) = 0;
  /// Gives the factors' memory back. The next factorization takes it anew.
  virtual void release() = 0;
  /// Work of the last factorization, as counted by the method; before it what analysis expects.
  [[nodiscard]] virtual FactorCost cost() const = 0;
  /// Of the unknowns, shape (n_dofs), until the next factorization is done: multigrid asks [mm].
  virtual void set_positions(std::span<const double>) {}
  /// Solves by GMRES around it, see Gmres::solve, which does so unless it has a way of its own.
  [[nodiscard]] virtual GmresReport iterate(Gmres& gmres,
                                            const SparseMatrix& matrix,
                                            std::span<const double> weights,
                                            std::span<const double> rhs,
                                            std::span<double> x,
                                            double tolerance,
                                            const Patience& patience,
                                            std::span<const std::vector<double>> known);
};

class DistributedSolver;

/// Gives a vector's memory back, which assigning {} would keep.
template <class T> void free_memory(std::vector<T>& values) { std::vector<T>().swap(values); }

/// Fill-reducing order of the unknowns: new position i holds unknown order[i].
[[nodiscard]] std::vector<Index> fill_reducing_order(const BlockPattern& pattern);

[[nodiscard]] std::unique_ptr<Factorization>
make_cholmod(std::shared_ptr<const Elimination> elimination);
/// L S L^T in single precision, S a diagonal of signs: for solutions that are iterated upon.
[[nodiscard]] std::unique_ptr<Factorization>
make_single(std::shared_ptr<const Elimination> elimination);
/// @param symmetric  LDL^T of the lower triangle instead of LU
[[nodiscard]] std::unique_ptr<Factorization>
make_mumps(const BlockPattern& pattern, std::span<const Index> order, bool symmetric);
/// LU in single precision: for solutions that are iterated upon.
[[nodiscard]] std::unique_ptr<Factorization> make_single_mumps(const BlockPattern& pattern,
                                                               std::span<const Index> order);
[[nodiscard]] std::unique_ptr<Factorization> make_umfpack(const BlockPattern& pattern,
                                                          std::span<const Index> order);

/// When something that has failed is tried again: with the next system, then after 2, 6, ... 30.
class RetryBackoff {
public:
  /// Counts a system. @return whether it is tried with this one
  [[nodiscard]] bool due() { return wait_-- <= 0; }
  void take(bool served);

private:
  int wait_ = 0;     ///< systems to go
  int failures_ = 0; ///< one after another
};

/// Whether systems go on with an earlier factorization. One of its own is due when the last took
/// more solves than systems have taken on the average since the factorization was made, its cost
/// shared among them: more of the like would only raise that average.
class ReusePolicy {
public:
  /// @param cost  of the factorization [solves]
  void begin(int cost) {
    spent_ = cost;
    systems_ = 1;
    last_ = 0;
  }
  /// Counts a system.
  void take(int solves) {
    spent_ += solves;
    ++systems_;
    last_ = solves;
  }
  [[nodiscard]] bool wants_new() const { return last_ * systems_ > spent_; }

private:
  int spent_ = 0; ///< with the factorization [solves]
  int systems_ = 0;
  int last_ = 0; ///< of the last system [solves]
};

/// Chooses among the factorizations and keeps their analyses for the life of the pattern.
class LinearSolver {
public:
  /// @pre pattern outlives the solver
  LinearSolver(const BlockPattern& pattern, SolverSettings settings);
  ~LinearSolver();

  /// From now on the entries that couple these unknowns with others are zero in every matrix: what
  /// is prescribed takes no part in factorizations.
  ///
  /// @param constrained  shape (n_dofs), not 0: such an unknown
  void set_constrained(std::span<const char> constrained);

  /// Solves matrix * x = rhs; `symmetric` promises that the matrix is.
  ///
  /// Where the last factorization reaches the tolerance with less work than a new one, none is
  /// made.
  [[nodiscard]] Outcome<SolveReport> solve(const SparseMatrix& matrix,
                                           bool symmetric,
                                           std::span<const double> rhs,
                                           std::span<double> x,
                                           const SolveOptions& options = {});

  /// Solves for another right-hand side, just after `solve` with the same matrix.
  /// The symmetric part's factorization serves here as well.
  [[nodiscard]] Outcome<SolveReport> solve_again(const SparseMatrix& matrix,
                                                 bool symmetric,
                                                 std::span<const double> rhs,
                                                 std::span<double> x,
                                                 double tolerance);

  /// Goes on as a new solver of the same pattern would: no factorization is held, and what has
  /// served before is not known. What it has taken so far stays.
  void forget();

  [[nodiscard]] const SolverWork& work() const { return work_; }

private:
  using Known = std::span<const std::vector<double>>; ///< directions to begin with

  /// Solves for any right-hand side.
  [[nodiscard]] Outcome<SolveReport> solve_system(const SparseMatrix& matrix,
                                                  bool symmetric,
                                                  std::span<const double> rhs,
                                                  std::span<double> x,
                                                  const SolveOptions& options);
  /// Makes a factorization of the pattern where there is none so far.
  template <class Make>
  Factorization& prepared(std::unique_ptr<Factorization>& factorization, Make make);
  [[nodiscard]] const std::vector<Index>& order();
  [[nodiscard]] const std::shared_ptr<const Elimination>& elimination();
  /// Large factors are held one at a time: Cholesky's and an LU's together are too much.
  void release_all_but(const Factorization& factorization);
  [[nodiscard]] bool
  factorize(Factorization& factorization, std::string_view method, const SparseMatrix& matrix);
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
  /// By GMRES with the factorization at hand, of a matrix close by or in single precision.
  [[nodiscard]] Outcome<SolveReport> solve_with_neighbour(std::string_view method,
                                                          const SparseMatrix& matrix,
                                                          std::span<const double> rhs,
                                                          std::span<double> x,
                                                          const SolveOptions& options,
                                                          Known known);
  /// L S L^T in single precision, where that is enough and has been lately.
  [[nodiscard]] bool factorize_in_single(const SparseMatrix& matrix,
                                         std::span<const double> rhs,
                                         const SolveOptions& options);
  /// Whether the factorization at hand gives a solution back that it is given the product of. A
  /// slender body's soft motions are lost in single precision, and a residual does not show it.
  /// (N.11)
  [[nodiscard]] bool agrees_with_itself(const SparseMatrix& matrix, std::span<const double> rhs);
  /// By the Cholesky factorization of the symmetric neighbour. (C.40)
  [[nodiscard]] Outcome<SolveReport> solve_with_symmetric_part(const SparseMatrix& matrix,
                                                               std::span<const double> rhs,
                                                               std::span<double> x,
                                                               const SolveOptions& options);
  [[nodiscard]] Outcome<SolveReport> solve_symmetric(const SparseMatrix& matrix,
                                                     std::span<const double> rhs,
                                                     std::span<double> x,
                                                     const SolveOptions& options);
  /// GMRES with the factorization at hand.
  [[nodiscard]] GmresReport iterate(const SparseMatrix& matrix,
                                    std::span<const double> rhs,
                                    std::span<double> x,
                                    double tolerance,
                                    const Patience& patience,
                                    Known known);
  /// Whether multigrid is asked for, or cheaper than factorizations and there.
  [[nodiscard]] bool takes_multigrid();
  /// By GMRES around a cycle of multigrid.
  [[nodiscard]] Outcome<SolveReport> solve_by_multigrid(const SparseMatrix& matrix,
                                                        std::span<const double> rhs,
                                                        std::span<double> x,
                                                        const SolveOptions& options);
  /// What all processes do; null: this one solves alone.
  [[nodiscard]] DistributedSolver* distributed() const;
  /// What multigrid is set up with. @return the reason if it cannot be
  [[nodiscard]] Outcome<Factorization*> prepared_multigrid();
  /// Around multigrid, or what a factorization by all processes leaves to do.
  [[nodiscard]] Outcome<SolveReport> solve_distributed(const SparseMatrix& matrix,
                                                       bool symmetric,
                                                       std::span<const double> rhs,
                                                       std::span<double> x,
                                                       const SolveOptions& options);
  [[nodiscard]] double weigh(const SparseMatrix& matrix);
  [[nodiscard]] Outcome<SolveReport> factorize_and_solve(const SparseMatrix& matrix,
                                                         bool symmetric,
                                                         std::span<const double> rhs,
                                                         std::span<double> x,
                                                         const SolveOptions& options);

  const BlockPattern* pattern_;
  SolverSettings settings_;
  std::vector<Index> order_;      ///< once it has been asked for
  std::vector<char> constrained_; ///< shape (n_dofs) or none
  std::shared_ptr<const Elimination> elimination_;
  std::unique_ptr<Factorization> single_;
  std::unique_ptr<Factorization> cholmod_;
  std::unique_ptr<Factorization> mumps_symmetric_;
  std::unique_ptr<Factorization> mumps_single_;
  std::unique_ptr<Factorization> mumps_;
  std::unique_ptr<Factorization> umfpack_;
  /// What a component does: multigrid, or in several processes all that is asked for.
  std::unique_ptr<Factorization> component_;
  std::optional<bool> takes_multigrid_; ///< once it has been decided
  Factorization* last_ = nullptr;       ///< holds a factorization of an earlier matrix
  ReusePolicy reuse_;                   ///< of that factorization
  /// The matrix that factorization is of.
  enum class FactorOf { previous, symmetrized, current } factor_of_ = FactorOf::previous;
  Gmres gmres_;
  std::vector<double> weights_; ///< of each unknown's residual
  SparseMatrix symmetric_part_;
  /// Of ways that have failed.
  struct Backoffs {
    RetryBackoff symmetric; ///< the symmetric part
    RetryBackoff single;    ///< L S L^T in single precision
    RetryBackoff multigrid;
  };
  Backoffs backoff_;
  bool single_lu_serves_ = true;           ///< whether LU in single precision is worth a try
  std::vector<std::vector<double>> first_; ///< a rough solution and a correction of it, if made
  double correction_ = 0.0;                ///< relative to that solution
  std::vector<double> residual_;
  SolverWork work_;
};

} // namespace billet::mechanics
