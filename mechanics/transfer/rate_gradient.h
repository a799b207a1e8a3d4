// How steeply the rate of plastic flow changes from place to place: where a mesh should be fine.
//
// Theory: docs/theory/process.md (P.22).

#pragma once

#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// The flow around the middle of an element.
struct RateGradient {
  Vec3 at;       ///< mean of the positions of its points [mm]
  double length; ///< over which the rate changes by its mean [mm]; infinite where it does not
};

/// For each element the length over which the rate of plastic flow changes by its mean, that over
/// the work done at an even stress. A linear field is seen exactly.
///
/// @param positions  of the integration points, shape (n_elements, points per element) [mm]
/// @param rate       of plastic strain or its growth over any time, of the same shape; >= 0
/// @param volumes    of the points, of the same shape [mm^3]
/// @return one for each element; none where nothing flows
[[nodiscard]] std::vector<RateGradient> rate_gradients(const Mesh& mesh,
                                                       std::span<const Vec3> positions,
                                                       std::span<const double> rate,
                                                       std::span<const double> volumes);

} // namespace billet::mechanics
