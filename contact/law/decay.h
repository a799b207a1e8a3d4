// How an offset of a contact point's gap decays: with the way gone. (C.41)

#pragma once

#include <algorithm>
#include <cmath>

namespace billet::contact {

/// What an increment leaves of an offset of the gap: at least a half, and it shrinks by no more
/// than a quarter of the way gone; faster, the tool would seem to draw back.
///
/// @param way  gone in the increment [mm]
[[nodiscard]] inline double decayed(double offset, double way) {
  constexpr double min_left = 0.5;
  constexpr double share_of_way = 0.25;
  const double size = std::abs(offset);
  return std::copysign(std::max(min_left * size, size - share_of_way * way), offset);
}

} // namespace billet::contact
