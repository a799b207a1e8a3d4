// What the program and its component for several processes say to each other.
//
// The component is a shared library of its own, loaded where it is needed: PETSc, which does the
// work, brings an MPI and a MUMPS that have the names of the sequential ones the program is linked
// with. No C++ crosses the border, only these plain types.
// Process 0 runs the program; the others serve its linear systems until it ends. What a function
// below does is done by all processes together: process 0 calls it, the others learn of it.
// Decision: docs/decisions/0034-several-processes.md.

#pragma once

namespace billet::mechanics {

/// Which nodes are coupled, and which process owns the rows of each.
struct DistributedPattern {
  int dim; ///< unknowns a node
  int n_nodes;
  const int* neighbour_start; ///< shape (n_nodes + 1)
  const int* neighbours;      ///< the node itself included
  const int* order;           ///< shape (n_nodes): the node at each place
  const int* part_start;      ///< shape (processes + 1): process p owns places p .. p + 1
};

/// What GMRES is preconditioned with.
enum DistributedMethod : int {
  distributed_multigrid,
  distributed_ldlt,   ///< MUMPS
  distributed_lu,     ///< MUMPS
  distributed_superlu ///< SuperLU_DIST
};

struct DistributedSetUp {
  DistributedMethod method;
  const double* positions; ///< shape (n_dofs) [mm]; multigrid asks
  double flops;            ///< out: of a factorization; 0: not known
  double entries;          ///< out: of factors, or of the matrices of all levels
};

struct DistributedSolve {
  const double* weights; ///< shape (n_dofs), > 0: of each unknown's residual
  const double* rhs;     ///< shape (n_dofs)
  double* x;             ///< shape (n_dofs), out
  double tolerance;      ///< relative, in the weighted norm
  int most;              ///< iterations
  int iterations;        ///< out
  double residual;       ///< out
  int converged;         ///< out, not 0: it did
};

/// Memory of one process [byte].
struct ProcessMemory {
  double peak;
  double after_distribution; ///< the largest at the end of this phase, and of the others
  double after_set_up;
  double after_solve;
};

/// How a function below ended.
enum DistributedStatus : int { distributed_done, distributed_failed, distributed_no_memory };

struct DistributedComponent {
  int version; ///< of this interface
  /// Starts MPI. @return how many processes there are; 0: it does not start
  int (*start)(int* number_of_this_process);
  /// What processes other than 0 do until the end. @return exit status
  int (*serve)();
  /// Process 0: ends the others. Nothing may be called afterwards.
  void (*end)();
  /// @return a number for the system, < 0: failed. The arrays stay as long as the system.
  int (*make)(const DistributedPattern* pattern);
  void (*destroy)(int system);
  /// Values of the matrix, row by row as the pattern has them. What was set up stays: it may be of
  /// another matrix than the one to be solved.
  int (*set_values)(int system, const double* values);
  int (*set_up)(int system, DistributedSetUp* set_up);
  int (*solve)(int system, DistributedSolve* solve);
  /// Gives the memory of the last set-up back.
  void (*release)(int system);
  void (*memory)(ProcessMemory* of_processes); ///< shape (processes)
  const char* (*reason)();                     ///< of the last failure
};

constexpr int distributed_version = 1;

/// Name of the only function of the shared library, of type DistributedEntry.
constexpr const char* distributed_entry = "billet_distributed_component";
using DistributedEntry = const DistributedComponent* (*)();

} // namespace billet::mechanics
