// What `solver.accuracy` stands for.
//
// Only what a case does not say itself. The figures are read off docs/trade.md.

#pragma once

#include "io/case/case.h"

namespace billet::io {

struct AccuracyPreset {
  double increments; ///< the first and the longest, of those of `standard` [-]
  double tolerance;  ///< of the relative residual [-]
};

[[nodiscard]] constexpr AccuracyPreset preset_of(Accuracy accuracy) {
  switch (accuracy) {
  case Accuracy::draft:
    return {1.0 / 0.6, 1e-4};
  case Accuracy::fine:
    return {0.05, 1e-6};
  case Accuracy::standard:
    break;
  }
  return {1.0, 1e-6};
}

} // namespace billet::io
