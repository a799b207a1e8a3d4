// What a linear system takes by factorization and by multigrid, before it is solved.
//
// Seconds of one thread on the machine that bench/scale was measured on: which of the two is
// cheaper, and so the bits of a result, must depend neither on the machine nor on its threads.
// Only where memory does not hold the factors has the machine a say.

#pragma once

#include <string>

namespace billet::mechanics {

/// What is known of the systems of a mesh.
struct SystemSize {
  int dim = 0;                 ///< unknowns a node
  double entries = 0.0;        ///< of the matrix
  double factor_entries = 0.0; ///< of its Cholesky factor
  double operations = 0.0;     ///< of its Cholesky factorization
};

/// Of a system, on average over those that use one factorization or set-up.
struct SystemCost {
  double seconds = 0.0;
  double memory = 0.0; ///< in addition to the matrix [byte]
};

[[nodiscard]] SystemCost cost_by_factorization(const SystemSize& size);
[[nodiscard]] SystemCost cost_by_multigrid(const SystemSize& size);

/// Whether multigrid is worth a thought: not where no system takes long. The factors need not be
/// known.
[[nodiscard]] bool may_pay(const SystemSize& size);

/// Whether multigrid solves such systems: where it is far cheaper, or where factors find no room.
/// Where metal flows all over a part it takes five times the cycles it takes while little of it
/// does, and more, so it has to be cheaper by that.
///
/// @param memory  that is left [byte]
[[nodiscard]] bool prefers_multigrid(const SystemSize& size, double memory);

/// The two costs in words, for `check` and the log.
[[nodiscard]] std::string costs_in_words(const SystemSize& size);

} // namespace billet::mechanics
