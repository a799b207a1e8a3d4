// A domain bounded by closed polygons: whether it is one, and how wide it is from wall to wall.
// Internal to geometry/. Theory: docs/theory/geometry.md (G.42).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"

#include <span>
#include <vector>

namespace billet::geometry {

/// Closed polygon; the domain lies on the left of the way.
using Polygon = std::vector<Vec2>;

/// The way through the domain from one wall to another that faces it.
struct Width {
  Vec2 from, to; ///< [mm]
  double width;  ///< [mm]
};

/// Widths of at most `most` along the inner normals of all sides and at corners that point inwards.
///
/// @throws Error(Fault::geometry), with the place, if polygons cross or touch themselves or each
///         other, or have the domain on the wrong side
[[nodiscard]] std::vector<Width> widths(std::span<const Polygon> polygons, double most);

} // namespace billet::geometry
