// Lengths of sides over a domain or a body, from samples. Internal to geometry/.
//
// The largest field that is nowhere larger than its samples and changes by no more than a given
// amount per distance. Theory: docs/theory/geometry.md (G.42).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

/// @tparam Point  Vec2 or Vec3
template <class Point> struct SampleOfSize {
  Point at;    ///< [mm]
  double size; ///< asked for there [mm]
};

template <class Point> class FieldOfSizes {
public:
  using SizeSample = SampleOfSize<Point>;

  /// @param max     largest size [mm]
  /// @param growth  most change of size per distance [-]
  FieldOfSizes(std::vector<SizeSample> samples, double max, double growth);

  /// min(max, min over samples of size + growth |x - at|); O(log n). (G.42)
  [[nodiscard]] double operator()(const Point& x) const;

private:
  /// Samples begin..end, in two halves where there are more than a few.
  struct Node {
    Point low, high;
    double least;
    std::uint32_t begin, end;
    std::uint32_t right; ///< second half; the first one is the next node; 0: not divided
  };
  void divide(std::uint32_t begin, std::uint32_t end);

  std::vector<SizeSample> samples_;
  std::vector<Node> nodes_;
  double max_, growth_;
};

using SizeSample = SampleOfSize<Vec2>;
using SizeField = FieldOfSizes<Vec2>;
using SpaceSizeSample = SampleOfSize<Vec3>;
using SpaceSizeField = FieldOfSizes<Vec3>;

} // namespace billet::geometry
