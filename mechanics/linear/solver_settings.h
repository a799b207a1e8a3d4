// How linear systems are solved, as far as it can be chosen.

#pragma once

namespace billet::mechanics {

/// Which factorization solves the systems.
enum class SolverChoice { automatic, cholmod, mumps, umfpack };

/// How systems are solved.
struct SolverSettings {
  SolverChoice choice = SolverChoice::automatic;
  int threads = 1; ///< of large factorizations; the bits of a result depend on them
};

} // namespace billet::mechanics
