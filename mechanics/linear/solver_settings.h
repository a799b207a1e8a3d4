// How linear systems are solved, as far as it can be chosen.

#pragma once

namespace billet::mechanics {

/// What solves the systems.
enum class SolverChoice { automatic, cholmod, mumps, umfpack, multigrid, superlu_dist };

/// How systems are solved.
struct SolverSettings {
  SolverChoice choice = SolverChoice::automatic;
};

} // namespace billet::mechanics
