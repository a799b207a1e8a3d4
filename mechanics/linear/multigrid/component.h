// What the program and its multigrid component say to each other.
//
// The component is a shared library of its own, loaded where it is needed: PETSc, which does the
// work, brings an MPI and a MUMPS that have the names of the sequential ones the program is linked
// with. No C++ crosses the border, only these plain types. Decision:
// docs/decisions/0033-multigrid.md.

#pragma once

namespace billet::mechanics {

/// A matrix by compressed rows, all unknowns of a node side by side, and where the nodes are.
struct MultigridSystem {
  int dim; ///< unknowns a node
  int n_dofs;
  const int* row_start;    ///< shape (n_dofs + 1)
  const int* columns;      ///< shape (n_entries), sorted within a row
  double* values;          ///< shape (n_entries), only read
  const double* positions; ///< shape (n_dofs) [mm]
};

/// What the component does. Every function that returns an int returns 0 when all went well;
/// `reason` says what did not.
struct MultigridComponent {
  int version;     ///< of this interface
  void* (*make)(); ///< null: `reason` says why
  int (*set_up)(void* multigrid, const MultigridSystem* system);
  /// Overwrites a right-hand side with what one cycle makes of it. The arrays of the system have to
  /// be where they were.
  int (*apply)(void* multigrid, double* x);
  void (*release)(void* multigrid); ///< the memory of the last set-up
  void (*destroy)(void* multigrid);
  const char* (*reason)();
  double (*entries)(const void* multigrid); ///< of the matrices of all levels but the finest
};

constexpr int multigrid_version = 1;

/// Name of the only function of the shared library, of type MultigridEntry.
constexpr const char* multigrid_entry = "billet_multigrid_component";
using MultigridEntry = const MultigridComponent* (*)();

} // namespace billet::mechanics
