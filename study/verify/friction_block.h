// The block that slides on a floor under one friction law.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/verify/case_bench.h"
#include "study/verify/figure.h"

namespace billet::study {

// The block: 10 x 10 mm, of metal that its supports keep from yielding.
inline constexpr double block_young = 200e3, block_poisson = 0.45; ///< [MPa], [-]
inline constexpr double block_yield = 300.0;                       ///< [MPa]
inline constexpr double block_size = 10.0;                         ///< [mm]
/// Of a point that sticks: ten times E over the depth of the element [MPa/mm].
inline constexpr double block_stick_stiffness = 10.0 * block_young / block_size;

/// A steady part of the slide.
struct BlockStep {
  double pressure;  ///< [MPa]
  double speed;     ///< [mm/s]
  double way = 0.0; ///< slid at its end [mm]
};

/// What slides, and how.
struct SlidingBlock {
  std::string name;             ///< of the case
  std::string friction;         ///< the table of the case
  std::vector<BlockStep> steps; ///< in turn, each long enough to become steady
  /// Newton's method ends at a relative residual of 1e-9; what the block is deformed by while the
  /// pressure rises has died away in the second half of a step.
  double tolerance = 1e-6;

  /// Of a step: the pressure is reached in the first half [s].
  static constexpr double duration() { return 2.0; }
};

/// The shear that a law asks for [MPa].
using ShearLaw = std::function<double(const BlockStep&)>;

/// The shear against the motion at the end of each step, with that of the law as reference.
/// @throws Error where the case cannot be run
[[nodiscard]] std::vector<Figure>
block_figures(const CaseBench& bench, const SlidingBlock& block, const ShearLaw& law);

} // namespace billet::study
