// Which of many boxes overlap.
//
// Boxes that only touch count. The order of the visits is not specified.

#pragma once

#include "geometry/base/box.h"

#include <cstdint>
#include <functional>
#include <span>

namespace billet::geometry {

/// Told of two boxes by their numbers; false ends the search.
using BoxPairVisit = std::function<bool(std::int32_t, std::int32_t)>;

/// Visits every pair i < j of overlapping boxes; false if `visit` ended it.
bool visit_box_pairs(std::span<const Box> boxes, const BoxPairVisit& visit);

/// Visits every overlapping pair of a box of `first` and one of `second`.
bool visit_box_pairs(std::span<const Box> first,
                     std::span<const Box> second,
                     const BoxPairVisit& visit);

} // namespace billet::geometry
