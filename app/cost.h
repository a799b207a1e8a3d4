// What a run will take, before it begins: memory and time.
//
// Memory follows from the elimination of the tangent, whose order is known. Time is a rule of thumb
// (docs/guide/results.md, "How long a run takes"): increments times iterations times the cost of an
// iteration, and how many iterations contact needs nobody knows before.

#pragma once

#include "mechanics/linear/solver_estimate.h"
#include "process/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace billet::app {

struct CostEstimate {
  std::int64_t unknowns = 0;
  std::int64_t entries = 0;    ///< of the tangent
  double factor_entries = 0.0; ///< of its factors
  double operations = 0.0;     ///< of a factorization
  double memory = 0.0;         ///< [byte]
  double increments = 0.0;     ///< if none is cut back
  double iterations = 0.0;     ///< of an increment
  double seconds = 0.0;        ///< of the run, with one thread
  bool by_multigrid = false;   ///< systems are solved that way
  mechanics::SystemSize systems = {};
};

/// The cost of a scene's run on its first mesh.
[[nodiscard]] CostEstimate cost_estimate(const process::Scene& scene);

/// The cost of the same run with elements half as long, and as many increments.
///
/// Unknowns grow by 2^dim; factors and operations as nested dissection has them, in the plane as
/// N log N and N^1.5, in space as N^(4/3) and N^2 (George, SIAM J. Numer. Anal. 10 (1973) 345-363).
///
/// @param dim  2 or 3
[[nodiscard]] CostEstimate finer_cost(const CostEstimate& cost, int dim);

/// That the machine has too little memory, "warning: ..."; none: it has enough, or nobody knows.
[[nodiscard]] std::optional<std::string> memory_warning(const CostEstimate& cost);

/// Scenes with more unknowns are worth the estimate before every run: its cost is negligible
/// compared with that of the run.
inline constexpr std::int64_t many_unknowns = 100'000;

} // namespace billet::app
