// How what a point or a face brings to a tool fades as it goes on. (C.41)

#pragma once

#include <algorithm>
#include <cmath>

namespace billet::contact {

/// What an increment leaves of an offset: at least half, and less by a quarter of the way gone at
/// most. Faster, the tool would seem to draw back.
///
/// @param way  gone in the increment [mm]
[[nodiscard]] inline double faded(double offset, double way) {
  constexpr double least = 0.5;
  constexpr double by_way = 0.25;
  const double size = std::abs(offset);
  return std::copysign(std::max(least * size, size - by_way * way), offset);
}

} // namespace billet::contact
